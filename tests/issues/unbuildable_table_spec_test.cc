// Symptom: a robot took a table_spec that no table can be built by (a box that the arm doesn't
// reach, a missing edge that counted as 0, a tolerance of 0 that was the default), and it was the
// job after the next activation that failed.
#include "server/services/robots.h"
#include "tests/server/testing/handler_test.h"

namespace truepose::services {
namespace {

using testing::HasFaultsAt;
using testing::IsOk;
using testing::Parse;
using Fields = std::vector<std::string>;

// Within reach, and with an edge at 0, which is as good a place as any other.
constexpr char kBox[] = R"pb(
  box {
    min_x_m: -0.6
    max_x_m: -0.4
    min_y_m: -0.2
    max_y_m: 0
    min_z_m: 0.2
    max_z_m: 0.4
    cone_rad: 0.2
    reference_joints: [ 0, -1, 1.5, -2, -1.57, 0 ]
  }
)pb";

class UnbuildableTableSpec : public testing::HandlerTest {
 protected:
  UnbuildableTableSpec() { AddRobot("ur10"); }

  absl::StatusOr<v1::Robot> Set(const v1::CompensationTableSpec& spec, double drift_mm = 0) {
    v1::UpdateRobotRequest request;
    request.mutable_robot()->set_name("robots/ur10");
    *request.mutable_robot()->mutable_table_spec() = spec;
    request.mutable_robot()->mutable_limits()->set_drift_rms_mm(drift_mm);
    request.mutable_update_mask()->add_paths("table_spec");
    request.mutable_update_mask()->add_paths("limits.drift_rms_mm");
    return UpdateRobot(call(), request);
  }
  absl::StatusOr<v1::Robot> Create(const v1::CompensationTableSpec& spec) {
    v1::CreateRobotRequest request = testing::RobotRequest("other", "2");
    *request.mutable_robot()->mutable_table_spec() = spec;
    return CreateRobot(call(), request);
  }
  v1::CompensationTableSpec spec_ = Parse<v1::CompensationTableSpec>(kBox);
};

TEST_F(UnbuildableTableSpec, WhatCanBeBuiltIsTaken) {
  EXPECT_THAT(Set(spec_), IsOk());
  EXPECT_THAT(Create(spec_), IsOk());
}

TEST_F(UnbuildableTableSpec, ABoxOutOfReach) {
  spec_.mutable_box()->set_min_x_m(50);
  spec_.mutable_box()->set_max_x_m(51);
  EXPECT_THAT(Set(spec_, -1),
              HasFaultsAt(Fields{"robot.limits.drift_rms_mm", "robot.table_spec.box"}))
      << "all faults at once";
  EXPECT_THAT(Create(spec_), HasFaultsAt(Fields{"robot.table_spec.box"}));
}

TEST_F(UnbuildableTableSpec, AMissingEdge) {
  spec_.mutable_box()->clear_min_z_m();
  EXPECT_THAT(Set(spec_), HasFaultsAt(Fields{"robot.table_spec.box.min_z_m"}));
  EXPECT_THAT(Create(spec_), HasFaultsAt(Fields{"robot.table_spec.box.min_z_m"}));
}

TEST_F(UnbuildableTableSpec, AToleranceOfNothing) {
  spec_.set_position_tolerance_m(0);
  spec_.set_rotation_tolerance_rad(-1e-4);
  const Fields both = {"robot.table_spec.position_tolerance_m",
                       "robot.table_spec.rotation_tolerance_rad"};
  EXPECT_THAT(Set(spec_), HasFaultsAt(both));
  EXPECT_THAT(Create(spec_), HasFaultsAt(both));
}

// A repeat gets its first answer, whatever is found of the spec by then.
TEST_F(UnbuildableTableSpec, ARepeatIsAnsweredAsBefore) {
  v1::UpdateRobotRequest request;
  request.set_request_id(testing::kSession1);
  request.mutable_robot()->set_name("robots/ur10");
  *request.mutable_robot()->mutable_table_spec() = spec_;
  const auto first = UpdateRobot(call(), request);
  ASSERT_THAT(first, IsOk());
  EXPECT_EQ(UpdateRobot(call(), request)->SerializeAsString(), first->SerializeAsString());
}

}  // namespace
}  // namespace truepose::services
