// Every fault of messages has its field path, comes with the others, and never becomes a number.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/fault.h"
#include "tests/convert/samples.h"

namespace truepose::convert {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> Fields(const absl::Status& status) {
  std::vector<std::string> fields;
  for (const Fault& fault : FaultsOf(status)) fields.push_back(fault.field);
  return fields;
}

TEST(Nominal, SampleAndMeasuringRobotAreValid) {
  EXPECT_TRUE(ValidateNominal(SampleNominal()).ok());
  EXPECT_TRUE(ValidateNominal(MeasuringRobot()).ok());
}

TEST(Nominal, AllFaultsAtOnce) {
  v1::Nominal nominal = SampleNominal();
  nominal.mutable_joints(1)->set_name("joint1");
  nominal.mutable_joints(2)->clear_type();
  nominal.mutable_geometry()->mutable_standard_dh()->mutable_rows(3)->set_a_m(NAN);
  nominal.mutable_joint_map()->add_scale(1);
  nominal.mutable_tools(0)->mutable_pose()->set_qw(2);
  EXPECT_THAT(Fields(ValidateNominal(nominal)),
              ElementsAre("joints[1].name", "joints[2].type", "geometry.standard_dh.rows[3].a_m",
                          "joint_map.scale", "tools[0].pose"));
}

TEST(Nominal, RowsAndJoints) {
  v1::Nominal nominal = SampleNominal();
  nominal.mutable_geometry()->mutable_standard_dh()->mutable_rows()->RemoveLast();
  EXPECT_THAT(Fields(ValidateNominal(nominal)), Contains("geometry.standard_dh.rows"));
  nominal.clear_geometry();
  EXPECT_THAT(Fields(ValidateNominal(nominal)), Contains("geometry"));
  EXPECT_FALSE(ValidateNominal(v1::Nominal()).ok());
}

TEST(Nominal, ParallelPrismaticJoints) {
  v1::Nominal nominal;
  for (int i = 0; i < 2; ++i) {
    nominal.add_joints()->set_name("slide" + std::to_string(i));
    nominal.mutable_joints(i)->set_type(v1::PRISMATIC);
    nominal.mutable_geometry()->mutable_standard_dh()->add_rows()->set_a_m(0.2);
  }
  EXPECT_THAT(Fields(ValidateNominal(nominal)), ElementsAre("joints[1]"));
}

TEST(Nominal, ElementsOfAChain) {
  v1::Nominal nominal;
  nominal.add_joints()->set_name("a");
  nominal.mutable_joints(0)->set_type(v1::REVOLUTE);
  v1::ElementaryTransform* element = nominal.mutable_geometry()->mutable_chain()->add_elements();
  element->set_joint(-2);
  nominal.mutable_geometry()->add_flange()->set_joint(0);
  EXPECT_THAT(Fields(ValidateNominal(nominal)),
              ElementsAre("geometry.chain.elements[0]", "geometry.chain.elements[0].joint",
                          "geometry.flange[0]", "geometry.flange[0].joint"));
}

TEST(Readings, AllFaultsAtOnce) {
  v1::CalibrationInput input = SampleInput();
  auto* readings = input.mutable_sessions(0)->mutable_readings();
  (*readings)[0].add_joints_measured(1);
  (*readings)[1].set_joints_measured(3, INFINITY);
  (*readings)[2].mutable_orientation()->set_w(5);
  (*readings)[3].set_row(9);
  (*readings)[4].mutable_position_sd_m()->set_y(-1);
  (*readings)[5].mutable_axis()->set_z(2);
  const absl::Status status = RunCalibration(input).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(Fields(status),
              ElementsAre("sessions[0].readings[0].joints_measured",
                          "sessions[0].readings[1].joints_measured[3]",
                          "sessions[0].readings[2].orientation", "sessions[0].readings[3].row",
                          "sessions[0].readings[4].position_sd_m", "sessions[0].readings[5].axis"));
}

// A slip of units or columns: 1e300 is finite, but its square is not, and the report would be full
// of inf.
TEST(Readings, SizesThatNoInstrumentHas) {
  v1::CalibrationInput input = SampleInput();
  auto* readings = input.mutable_sessions(0)->mutable_readings();
  (*readings)[0].mutable_position_m()->set_x(1e300);
  (*readings)[1].set_joints_measured(0, -1e18);
  (*readings)[2].mutable_position_sd_m()->set_z(1e5);
  EXPECT_THAT(Fields(RunCalibration(input).status()),
              ElementsAre("sessions[0].readings[0].position_m.x",
                          "sessions[0].readings[1].joints_measured[0]",
                          "sessions[0].readings[2].position_sd_m.z"));
}

TEST(Options, AllFaultsAtOnce) {
  v1::CalibrationInput input = SampleInput();
  input.mutable_options()->set_split("thirds");
  input.mutable_options()->set_model("magic");
  input.mutable_options()->set_estimator("oracle");
  input.mutable_options()->set_observe(static_cast<v1::Observe>(9));
  EXPECT_THAT(
      Fields(RunCalibration(input).status()),
      ElementsAre("options.split", "options.model", "options.estimator", "options.observe"));
}

TEST(Options, UnknownColumnsAndTools) {
  v1::CalibrationInput input = SampleInput();
  input.mutable_options()->set_group_column("day");
  EXPECT_THAT(Fields(RunCalibration(input).status()), ElementsAre("options.group_column"));
  input.mutable_options()->clear_group_column();
  input.mutable_options()->set_split("column:day=monday");
  EXPECT_THAT(Fields(RunCalibration(input).status()), ElementsAre("options.split"));
  input.mutable_options()->set_split("even-odd");
  input.mutable_options()->set_nominal_tool("hammer");
  const absl::Status status = RunCalibration(input).status();
  EXPECT_THAT(Fields(status), ElementsAre("options.nominal_tool"));
  EXPECT_THAT(std::string(status.message()), HasSubstr("pin"));
}

TEST(Input, NoSessionAndNoReading) {
  v1::CalibrationInput input = SampleInput();
  input.mutable_sessions(0)->clear_readings();
  EXPECT_FALSE(RunCalibration(input).ok());
  input.clear_sessions();
  EXPECT_THAT(Fields(RunCalibration(input).status()), ElementsAre("sessions"));
}

TEST(Input, TheSameSessionTwice) {
  v1::CalibrationInput input = SampleInput();
  *input.add_sessions() = input.sessions(0);
  EXPECT_THAT(Fields(RunCalibration(input).status()), ElementsAre("sessions[1]"));
}

// A joint beyond its limit is a warning with its rows; with strict_limits it is an error.
TEST(Limits, WarningOrError) {
  v1::CalibrationInput input = SampleInput();
  input.mutable_sessions(0)->mutable_readings(7)->set_joints_measured(2, 3.5);
  input.mutable_sessions(0)->mutable_readings(9)->set_joints_measured(2, 3.5);
  const auto calibration = RunCalibration(input);
  ASSERT_TRUE(calibration.ok()) << calibration.status();
  EXPECT_THAT(calibration->report().warnings(),
              ElementsAre("joint joint3 is above its limit of 171.887 deg in rows 7, 9"));
  input.mutable_options()->set_strict_limits(true);
  EXPECT_THAT(Fields(RunCalibration(input).status()), ElementsAre("sessions[0].readings"));
}

TEST(Limits, ManyRowsAreCut) {
  v1::CalibrationInput input = SampleInput(60);
  for (v1::Reading& reading : *input.mutable_sessions(0)->mutable_readings())
    reading.set_joints_measured(0, -3.5);
  const auto& readings = input.sessions(0).readings();
  const auto warnings = LimitWarnings(input.nominal(), {readings.begin(), readings.end()});
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("below its limit of -171.887 deg in rows 0, 1,"));
  EXPECT_THAT(warnings[0], HasSubstr("and 40 more"));
}

}  // namespace
}  // namespace truepose::convert
