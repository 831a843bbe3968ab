// Symptoms: metres under x_mm and degrees under q1_rad ended in faults or verdicts that spoke of
// anything but units; a session without usable rows was told "found none that can be used", twice.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/fault.h"
#include "tests/convert/samples.h"

namespace truepose::convert {
namespace {

using ::testing::HasSubstr;

// What a run says, as a report's warnings or as faults.
std::string Said(const v1::CalibrationInput& input) {
  const auto calibration = RunCalibration(input);
  if (!calibration.ok()) return std::string(calibration.status().message());
  std::string text;
  for (const std::string& warning : calibration->report().warnings()) text += warning + "\n";
  return text;
}

v1::CalibrationInput PositionsTimes(double factor) {
  v1::CalibrationInput input = SampleInput(60);
  for (v1::Reading& reading : *input.mutable_sessions(0)->mutable_readings()) {
    v1::Vector3& p = *reading.mutable_position_m();
    p.set_x(factor * p.x());
    p.set_y(factor * p.y());
    p.set_z(factor * p.z());
  }
  return input;
}

TEST(WrongUnits, MetresUnderMillimetres) {
  EXPECT_THAT(Said(PositionsTimes(1e-3)), HasSubstr("are they metres (x_m)?"));
}

TEST(WrongUnits, MillimetresUnderMetres) {
  EXPECT_THAT(Said(PositionsTimes(1e3)), HasSubstr("are they millimetres (x_mm)?"));
}

TEST(WrongUnits, DegreesUnderRadians) {
  v1::CalibrationInput input = SampleInput(60);
  for (v1::Reading& reading : *input.mutable_sessions(0)->mutable_readings())
    for (double& q : *reading.mutable_joints_measured()) q *= 180 / M_PI;
  EXPECT_THAT(Said(input), HasSubstr("are these degrees (q1_deg)?"));
}

// Figures in their own units are no ground for a hint; nor is a target at the end of a long lever.
TEST(WrongUnits, RightOnesAreNotDoubted) {
  EXPECT_EQ(Said(SampleInput(60)), "");
  v1::CalibrationInput lever = SampleInput(60);
  lever.mutable_nominal()->mutable_tools(0)->mutable_pose()->set_z_m(2);
  EXPECT_THAT(Said(lever), Not(HasSubstr("are they")));
}

// One fault, with what is there and the columns that would do.
TEST(NoUsableRow, SaysWhichColumnsAreNeeded) {
  v1::CalibrationInput input = SampleInput(60);
  for (v1::Reading& reading : *input.mutable_sessions(0)->mutable_readings()) {
    reading.clear_position_m();
    reading.clear_position_sd_m();
    reading.clear_orientation();
  }
  const std::vector<Fault> faults = FaultsOf(RunCalibration(input).status());
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].found, "none that can be used in 60 rows with joints");
  for (const char* word :
       {"position", "orientation", "axis", "distance", "--fixture", "--feature-column"})
    EXPECT_THAT(faults[0].expected, HasSubstr(word));
}

}  // namespace
}  // namespace truepose::convert
