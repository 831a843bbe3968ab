#include "server/services/drift_checks.h"

#include "server/services/robots.h"
#include "tests/server/services/recalibration_testing.h"

namespace truepose::services {
namespace {

using testing::HasCode;
using testing::HasFaultsAt;
using testing::HasFields;
using testing::IsOk;
using testing::kSession2;
using Fields = std::vector<std::string>;

constexpr char kCheck1[] = "00000000-0000-4000-8000-0000000000d1";
constexpr char kCheck2[] = "00000000-0000-4000-8000-0000000000d2";
constexpr char kChecked[] = "sessions/00000000-0000-4000-8000-000000000002";

class DriftChecksTest : public RecalibrationFixture {
 protected:
  DriftChecksTest() { AddSimulatedSession(kSession2, "ur10", 30); }

  void SetLimit(double drift_rms_mm) {
    v1::UpdateRobotRequest request;
    request.mutable_robot()->set_name(kRobot);
    request.mutable_robot()->mutable_limits()->set_drift_rms_mm(drift_rms_mm);
    request.mutable_update_mask()->add_paths("limits");
    ASSERT_THAT(UpdateRobot(call(), request), IsOk());
  }

  absl::StatusOr<v1::DriftCheck> Check(const std::string& id, const std::string& session = kChecked,
                                       const std::string& calibration = "") {
    v1::CreateDriftCheckRequest request;
    request.set_parent(kRobot);
    request.set_drift_check_id(id);
    request.mutable_drift_check()->set_session(session);
    request.mutable_drift_check()->set_calibration(calibration);
    return CreateDriftCheck(As("anna"), request);
  }
};

// Would catch a check that isn't stored, or not of the active calibration.
TEST_F(DriftChecksTest, IsStoredWithWhatItFound) {
  const auto check = Check(kCheck1);
  ASSERT_THAT(check, IsOk());
  EXPECT_THAT(*check, HasFields("calibration: 'robots/ur10/calibrations/1' poses: 30 "
                                "limit_exceeded: false recalibration_request: ''"));
  EXPECT_GT(check->position_mm().rms(), 0.0);
  EXPECT_FALSE(check->findings().empty());
  const auto again = Check(kCheck1);
  ASSERT_THAT(again, IsOk());
  EXPECT_EQ(again->SerializeAsString(), check->SerializeAsString());
  EXPECT_THAT(Check(kCheck1, absl::StrCat("sessions/", testing::kSession1)),
              HasCode(absl::StatusCode::kAlreadyExists));
  EXPECT_EQ(All<v1::DriftCheck>().size(), 1u);
}

// Would catch a limit that is crossed in silence, or a request that is no part of the check's
// commit.
TEST_F(DriftChecksTest, BeyondTheLimitARequestIsRaised) {
  SetLimit(1e-6);
  const auto check = Check(kCheck1);
  ASSERT_THAT(check, IsOk());
  const v1::RecalibrationRequest open = Open();
  EXPECT_TRUE(check->limit_exceeded());
  EXPECT_EQ(check->recalibration_request(), open.name());
  EXPECT_THAT(
      open, HasFields(absl::StrCat("cause: CAUSE_FAILED_CHECK raised_by: '", check->name(), "'")));
  EXPECT_NE(open.pose_set(), "");
  EXPECT_EQ(open.revision(), check->revision());
  const auto second = Check(kCheck2);
  ASSERT_THAT(second, IsOk());
  EXPECT_EQ(second->recalibration_request(), "") << "one is open already";
  EXPECT_EQ(All<v1::RecalibrationRequest>().size(), 1u);
}

// Would catch a flag of the policy that does nothing.
TEST_F(DriftChecksTest, APolicySaysWhetherAFailedCheckRaises) {
  SetLimit(1e-6);
  SetPolicy("on_failed_check: false");
  ASSERT_THAT(Check(kCheck1), IsOk());
  EXPECT_EQ(Open().name(), "");
  SetPolicy("on_failed_check: true", "checks");
  ASSERT_THAT(Check(kCheck2), IsOk());
  EXPECT_EQ(Open().cause(), v1::CAUSE_FAILED_CHECK);
}

// Would catch a check of readings that may still change, or against a calibration that acts on
// nothing.
TEST_F(DriftChecksTest, NeedsASealedSessionAndTheActiveCalibration) {
  AddRobot("other");
  AddSession(testing::kUnknown, "other", 3);
  const auto foreign =
      Check(kCheck1, absl::StrCat("sessions/", testing::kUnknown), "robots/ur10/calibrations/7");
  EXPECT_THAT(foreign, HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_THAT(testing::FieldsOf(foreign.status()),
              ::testing::ElementsAre("drift_check.session", "drift_check.session",
                                     "drift_check.calibration"));
  EXPECT_THAT(Check("x", "nothing"), HasFaultsAt(Fields{"drift_check_id", "drift_check.session"}));
  EXPECT_THAT(Check(kCheck1, "sessions/00000000-0000-4000-8000-0000000000ff"),
              HasCode(absl::StatusCode::kNotFound));
  EXPECT_TRUE(All<v1::DriftCheck>().empty());
}

}  // namespace
}  // namespace truepose::services
