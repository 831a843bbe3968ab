#include "convert/drift.h"

#include <gtest/gtest.h>

#include "core/base/fault.h"
#include "tests/convert/samples.h"

namespace truepose::convert {
namespace {

constexpr char kStand[] = "robots/a/placements/stand";

// A calibration of half the rows of one simulated session, and checks out of the other half: the
// same robot, instrument and target.
class DriftCheckTest : public ::testing::Test {
 protected:
  DriftCheckTest() : input_(SampleInput(80, "")) {
    v1::SessionInput* all = input_.mutable_sessions(0);
    check_.mutable_session()->set_name("sessions/check");
    while (all->readings_size() > 50) {
      *check_.add_readings() = all->readings(all->readings_size() - 1);
      check_.mutable_readings(check_.readings_size() - 1)->set_row(check_.readings_size() - 1);
      all->mutable_readings()->RemoveLast();
    }
    all->mutable_session()->set_name("sessions/calibration");
  }

  v1::Session* calibrated() { return input_.mutable_sessions(0)->mutable_session(); }
  v1::Session* checked() { return check_.mutable_session(); }

  v1::DriftCheck Check(double limit_mm = 0) {
    auto calibration = RunCalibration(input_);
    EXPECT_TRUE(calibration.ok()) << calibration.status();
    std::vector<v1::Session> sessions;
    for (const v1::SessionInput& session : input_.sessions()) sessions.push_back(session.session());
    const auto result = RunDriftCheck(input_.nominal(), *calibration, sessions, check_, limit_mm);
    EXPECT_TRUE(result.ok()) << result.status();
    return result.ok() ? *result : v1::DriftCheck();
  }

  void MoveCheck(double x_m) {
    for (v1::Reading& row : *check_.mutable_readings())
      row.mutable_position_m()->set_x(row.position_m().x() + x_m);
  }

  static bool HasPart(const v1::DriftCheck& check, const std::string& name) {
    for (const v1::DriftPart& part : check.parts())
      if (part.part() == name) return true;
    return false;
  }

  static bool Says(const v1::DriftCheck& check, const std::string& text) {
    for (const std::string& finding : check.findings())
      if (finding.find(text) != std::string::npos) return true;
    return false;
  }

  v1::CalibrationInput input_;
  v1::SessionInput check_;
};

// The same placement: held, nothing changed. 0.5 mm along x of M is then a motion of the base, in
// mm.
TEST_F(DriftCheckTest, SamePlacementHoldsBaseAndTool) {
  calibrated()->set_placement(kStand);
  checked()->set_placement(kStand);
  v1::DriftCheck check = Check(0.01);
  EXPECT_EQ(check.session(), "sessions/check");
  EXPECT_EQ(check.poses(), 30);
  EXPECT_FALSE(check.changed());
  EXPECT_TRUE(check.base_observable());
  EXPECT_EQ(check.parts_size(), 6);
  EXPECT_EQ(check.degrees_of_freedom(), 180);
  EXPECT_TRUE(check.limit_exceeded());
  EXPECT_TRUE(Says(check, "beyond the limit of 0.010 mm"));
  MoveCheck(5e-4);
  check = Check();
  EXPECT_TRUE(check.changed());
  EXPECT_EQ(check.attributed_to(), "base or joint 1");
  EXPECT_EQ(check.parts(0).part(), "base or joint 1");
  EXPECT_NEAR(check.parts(0).change_mm(), 0.5, 0.1);
  EXPECT_FALSE(check.limit_exceeded());
}

// Nothing is known of the placement: base is refitted, and it is said in these words.
TEST_F(DriftCheckTest, UnknownPlacementRefits) {
  MoveCheck(0.3);
  const v1::DriftCheck check = Check();
  EXPECT_FALSE(check.changed());
  EXPECT_FALSE(check.base_observable());
  EXPECT_TRUE(Says(check, "base: not observable"));
  EXPECT_FALSE(HasPart(check, "base or joint 1"));
  EXPECT_FALSE(HasPart(check, "tool or last joint"));
  EXPECT_EQ(check.parts_size(), 4);
}

// Another instrument on the stand, another stand, or another place of the readings: not held.
TEST_F(DriftCheckTest, OtherSetUpsAreNotHeld) {
  calibrated()->set_placement(kStand);
  calibrated()->set_instrument("instruments/1");
  checked()->set_placement(kStand);
  checked()->set_instrument("instruments/2");
  EXPECT_FALSE(Check().base_observable());
  checked()->set_instrument("instruments/1");
  EXPECT_TRUE(Check().base_observable());
  for (v1::Reading& row : *check_.mutable_readings()) row.set_placement("window");
  EXPECT_FALSE(Check().base_observable());
  for (v1::Reading& row : *check_.mutable_readings()) row.clear_placement();
  checked()->set_placement("robots/a/placements/other");
  EXPECT_FALSE(Check().base_observable());
}

// A named target is held wherever the instrument stands; another name is not.
TEST_F(DriftCheckTest, NamedTargetIsHeld) {
  for (v1::Reading& row : *input_.mutable_sessions(0)->mutable_readings()) row.set_target("SMR 7");
  for (v1::Reading& row : *check_.mutable_readings()) row.set_target("SMR 7");
  v1::DriftCheck check = Check();
  EXPECT_FALSE(check.base_observable());
  EXPECT_TRUE(HasPart(check, "tool or last joint"));
  for (v1::Reading& row : *check_.mutable_readings()) row.set_target("SMR 8");
  check = Check();
  EXPECT_FALSE(HasPart(check, "tool or last joint"));
  EXPECT_TRUE(Says(check, "tool: not observable"));
}

// A fixture on the session alone says nothing of where M is: the readings were not in its features.
TEST_F(DriftCheckTest, FixtureCountsWhereReadingsStandInIt) {
  calibrated()->set_fixture("fixtures/1");
  checked()->set_fixture("fixtures/1");
  EXPECT_FALSE(Check().base_observable());
}

// The frame of the right one of two sessions, by name "session 2" and covariance "base[session 2]".
TEST_F(DriftCheckTest, FrameOfTheSessionThatSharesThePlacement) {
  v1::SessionInput* second = input_.add_sessions();
  second->mutable_session()->set_name("sessions/second");
  second->mutable_session()->set_placement(kStand);
  v1::SessionInput* first = input_.mutable_sessions(0);
  while (first->readings_size() > 25) {
    *second->add_readings() = first->readings(first->readings_size() - 1);
    second->mutable_readings(second->readings_size() - 1)->set_row(second->readings_size() - 1);
    first->mutable_readings()->RemoveLast();
  }
  // The first session's instrument stood elsewhere.
  for (v1::Reading& row : *first->mutable_readings())
    row.mutable_position_m()->set_y(row.position_m().y() + 2);
  checked()->set_placement(kStand);
  const v1::DriftCheck check = Check();
  EXPECT_TRUE(check.base_observable());
  EXPECT_FALSE(check.changed()) << check.p_value();
  EXPECT_LT(check.position_mm().rms(), 0.3);  // noise of 0.05 mm; 2 m for the wrong frame
}

TEST_F(DriftCheckTest, Faults) {
  const auto calibration = RunCalibration(input_);
  ASSERT_TRUE(calibration.ok());
  check_.mutable_readings(3)->add_joints_measured(0);
  auto result = RunDriftCheck(input_.nominal(), *calibration, {}, check_);
  EXPECT_EQ(result.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(FaultsOf(result.status())[0].field, "sessions[0].readings[3].joints_measured");
  v1::Calibration of_another = *calibration;
  of_another.mutable_report()->set_convention("another");
  result = RunDriftCheck(input_.nominal(), of_another, {}, check_);
  EXPECT_EQ(FaultsOf(result.status())[0].field, "calibration.report.convention");
}

}  // namespace
}  // namespace truepose::convert
