// Symptom: compliance identified from torque columns of a robot without masses; `compensate`
// dropped it in silence and left the arm 0.7 mm off, and so did `evaluate` on a session without
// torques.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/fault.h"
#include "tests/convert/samples.h"

namespace truepose::convert {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

v1::CalibrationInput WithTorques() {
  v1::CalibrationInput input = SampleInput(120);
  input.mutable_options()->set_effects("compliance");
  for (v1::Reading& reading : *input.mutable_sessions(0)->mutable_readings())
    for (int j = 0; j < 6; ++j) reading.add_joint_torques_nm((reading.row() * (j + 3)) % 17 - 8);
  return input;
}

v1::Calibration Calibrated(const v1::CalibrationInput& input) {
  auto calibration = RunCalibration(input);
  EXPECT_TRUE(calibration.ok()) << calibration.status();
  calibration->mutable_report()->set_verdict("apply");  // of which this test does not speak
  return *std::move(calibration);
}

v1::CompensateRequest OneTarget(const v1::CalibrationInput& input) {
  v1::CompensateRequest request;
  *request.add_targets()->mutable_joints() = input.sessions(0).readings(3).joints_measured();
  return request;
}

v1::LinkMass SomeMass() {
  v1::LinkMass mass;
  mass.set_joint(1);
  mass.set_mass_kg(4);
  mass.set_x_m(0.3);
  return mass;
}

TEST(MeasuredTorques, AreMissedInTargets) {
  const v1::CalibrationInput input = WithTorques();
  const v1::Calibration calibration = Calibrated(input);
  EXPECT_THAT(calibration.report().warnings(), Contains(HasSubstr("only where torques are known")));
  const absl::Status status =
      RunCompensation(input.nominal(), calibration, OneTarget(input)).status();
  ASSERT_EQ(FaultsOf(status).size(), 1u) << status;
  EXPECT_THAT(FaultsOf(status)[0].found, HasSubstr("compliance from measured torques"));
  EXPECT_THAT(FaultsOf(status)[0].expected, HasSubstr("masses in the robot file"));
}

TEST(MeasuredTorques, AreMissedInASession) {
  const v1::CalibrationInput input = WithTorques();
  const v1::Calibration calibration = Calibrated(input);
  EXPECT_TRUE(
      RunEvaluation(input.nominal(), calibration, input.sessions(0), v1::OBSERVE_UNSPECIFIED).ok());
  v1::SessionInput without = input.sessions(0);
  without.mutable_readings(8)->clear_joint_torques_nm();
  const absl::Status status =
      RunEvaluation(input.nominal(), calibration, without, v1::OBSERVE_UNSPECIFIED).status();
  ASSERT_EQ(FaultsOf(status).size(), 1u) << status;
  EXPECT_THAT(FaultsOf(status)[0].found, HasSubstr("no joint torques in 1 of 120 readings"));
}

// With masses torques of gravity are known at any target: nothing to refuse, nothing to warn of.
TEST(MeasuredTorques, AreNotNeededWithMasses) {
  v1::CalibrationInput input = WithTorques();
  *input.mutable_nominal()->add_masses() = SomeMass();
  const v1::Calibration calibration = Calibrated(input);
  EXPECT_THAT(calibration.report().warnings(), Not(Contains(HasSubstr("torques are known"))));
  const auto response = RunCompensation(input.nominal(), calibration, OneTarget(input));
  EXPECT_TRUE(response.ok()) << response.status();
}

}  // namespace
}  // namespace truepose::convert
