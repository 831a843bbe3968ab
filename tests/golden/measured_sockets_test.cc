// A robot calibrated without any instrument: a Panda whose ball was put into two sockets, 50 mm
// apart, at six places (panda_3). Figures are of control rows against their own socket's mean, as
// those of the separate implementations (0.211 and 0.216 even-odd, 0.234 to 0.240 placements left
// out). Measured here: 0.2105 even-odd, 0.196 to 0.235 placements left out, frontright 0.235,
// distances of sockets within 0.08.
#include <gtest/gtest.h>

#include <iostream>
#include <string>

#include "formats/fixture_file.h"
#include "tests/golden/measured.h"

namespace truepose {
namespace {

v1::CalibrationReport ReportOf(const std::string& split) {
  v1::CalibrationInput input =
      testing::MeasuredInput("franka_panda.yaml", "mukca_panda/panda_3.csv");
  const auto fixture =
      formats::ReadFixtureFile(TRUEPOSE_SOURCE_DIR "/deploy/examples/sockets.yaml");
  EXPECT_TRUE(fixture.ok()) << fixture.status();
  if (fixture.ok()) *input.mutable_options()->mutable_fixture() = fixture->fixture;
  input.mutable_options()->set_feature_column("hole");
  input.mutable_options()->set_split(split);
  const v1::CalibrationReport report = testing::MustCalibrate(input).report();
  std::cout << split << ": " << report.control_places().after().position_mm().rms()
            << " mm, distance of the sockets " << report.largest_spacing_error_mm() << " mm\n";
  return report;
}

void ExpectApplied(const v1::CalibrationReport& report) {
  EXPECT_TRUE(report.verdict() == "apply" || report.verdict() == "apply_within_volume")
      << report.verdict();
}

int IdentifiedIn(const v1::CalibrationReport& report, v1::ParameterGroup group) {
  int count = 0;
  for (const v1::ParameterValue& value : report.parameters().values())
    count += value.group() == group;
  return count;
}

// Would catch sockets that are mixed up, and a scale that the spacing does not give.
TEST(MeasuredSockets, EvenOdd) {
  const v1::CalibrationReport report = ReportOf("even-odd");
  EXPECT_LE(report.control_places().after().position_mm().rms(), 0.220);
  EXPECT_LE(report.largest_spacing_error_mm(), 0.10);
  EXPECT_EQ(report.control_places().poses(), 193);
  // 4 R - 6 = 22 of the robot by Eq. 13, and three of a point on the tool.
  EXPECT_EQ(IdentifiedIn(report, v1::INTERNAL), 22);
  EXPECT_EQ(IdentifiedIn(report, v1::TOOL), 3);
  ExpectApplied(report);
}

// One ball says where the tool's point is and little of how the hand is turned (3.4 deg).
// Would catch an "apply" without a word of it, after which compensation turns the hand by 4.6 deg.
TEST(MeasuredSockets, TheVerdictSaysThatTheOrientationIsOpen) {
  const v1::CalibrationReport report = ReportOf("even-odd");
  EXPECT_EQ(report.verdict(), "apply_within_volume");
  std::string reasons;
  for (const std::string& reason : report.verdict_reasons()) reasons += reason + "\n";
  EXPECT_NE(reasons.find("the orientation of the flange is known to 3."), std::string::npos)
      << reasons;
}

// Each of the six places shows all of its base but a turn about the line of its two sockets: rank
// 22 + 3 + 6 * 5. Would catch a rank that is judged millimetres off the sockets, where the turns
// seem to be seen (61, with standard deviations of degrees and centimetres), and a report that
// leaves the reader to guess which motion is meant.
TEST(MeasuredSockets, TurnsAboutTheLineOfTheSocketsAreNotObservable) {
  const v1::CalibrationReport report = ReportOf("even-odd");
  EXPECT_EQ(report.summary().rank(), 55);
  EXPECT_EQ(IdentifiedIn(report, v1::BASE), 30);
  int turns = 0;
  for (const v1::Redundancy& redundancy : report.redundancies()) {
    if (!redundancy.dropped().starts_with("base[")) continue;
    EXPECT_NE(redundancy.reason().find("about the line of its sockets, along (1, 0, 0)"),
              std::string::npos)
        << redundancy.reason();
    turns += redundancy.reason().starts_with("turn of base[");
  }
  EXPECT_EQ(turns, 6);
  // What is left of the bases is known like the sockets: not by centimetres and degrees.
  for (const v1::ParameterValue& value : report.parameters().values()) {
    if (value.group() != v1::BASE) continue;
    EXPECT_LT(value.sd(), 1) << value.name() << " " << value.unit();
  }
}

class PlacementLeftOut : public ::testing::TestWithParam<const char*> {};

// The robot at a place where it was not calibrated. Would catch frames of placements that take up
// what belongs to the robot.
TEST_P(PlacementLeftOut, IsPredicted) {
  const std::string name = GetParam();
  const v1::CalibrationReport report = ReportOf("column:placement=" + name);
  EXPECT_LE(report.control_places().after().position_mm().rms(),
            name == "frontright" ? 0.245 : 0.25);
  EXPECT_LE(report.largest_spacing_error_mm(), 0.10);
  ExpectApplied(report);
}

INSTANTIATE_TEST_SUITE_P(Panda3, PlacementLeftOut,
                         ::testing::Values("backcenter", "backleft", "backright", "frontcenter",
                                           "frontleft", "frontright"),
                         [](const auto& info) { return std::string(info.param); });

}  // namespace
}  // namespace truepose
