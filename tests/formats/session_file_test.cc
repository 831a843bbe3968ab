#include "formats/session_file.h"

#include <numbers>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/formats/samples.h"

namespace truepose::formats {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

SessionFile Parse(std::string_view text, std::string_view joints = "RR") {
  return ValueOf(ParseSessionFile(text, "folder/s.csv", RobotOf(joints)));
}

// Catches: units mixed up, columns taken by place instead of by name, a wrong row or source.
TEST(SessionFileTest, ReadsAFullPoseInAnyOrderAndUnit) {
  const SessionFile file = Parse(
      "qw,qx,qy,qz,z_mm,x_mm,y_m,q2_rad,q1_deg,sx_mm,sy_mm,sz_m\n"
      "0.6,0,0.8,0,3,1000,0.002,-0.5,90,0.01,0,0.00003\n");
  ASSERT_EQ(file.readings.size(), 1);
  const v1::Reading& r = file.readings[0];
  EXPECT_EQ(file.session.source(), "s.csv");
  EXPECT_THAT(file.warnings, IsEmpty());
  EXPECT_EQ(r.row(), 0);
  EXPECT_THAT(r.joints_measured(), ElementsAre(std::numbers::pi / 2, -0.5));
  EXPECT_THAT(r.joints_commanded(), IsEmpty());
  EXPECT_EQ(r.position_m().x(), 1);
  EXPECT_EQ(r.position_m().y(), 0.002);
  EXPECT_EQ(r.position_m().z(), 0.003);
  EXPECT_EQ(r.orientation().x(), 0);
  EXPECT_EQ(r.orientation().y(), 0.8);
  EXPECT_EQ(r.orientation().w(), 0.6);
  EXPECT_EQ(r.position_sd_m().x(), 0.00001);
  EXPECT_EQ(r.position_sd_m().z(), 0.00003);
  EXPECT_FALSE(r.has_axis());
  EXPECT_FALSE(r.has_temperature_c());
}

// Catches: commanded joints taken for measured ones, a prismatic joint scaled as an angle.
TEST(SessionFileTest, ReadsCommandedAndPrismaticJoints) {
  const SessionFile file = Parse(
      "q1_rad,q2_mm,q1_cmd_deg,q2_cmd_m\n"
      "0.1,250,180,0.3\n",
      "RP");
  ASSERT_EQ(file.readings.size(), 1);
  EXPECT_THAT(file.readings[0].joints_measured(), ElementsAre(0.1, 0.25));
  EXPECT_THAT(file.readings[0].joints_commanded(), ElementsAre(std::numbers::pi, 0.3));
}

TEST(SessionFileTest, ReadsAxisSurroundingsAndNames) {
  const SessionFile file = Parse(
      "time,placement,target,group,q1_rad,q2_rad,axis_x,axis_y,axis_z,temp_C,tau1_Nm,tau2_Nm\n"
      "2025-03-14T09:26:53.5+01:00,left,T1,a,0,0,0,0.6,0.8,21.5,3,-4\n");
  ASSERT_EQ(file.readings.size(), 1);
  const v1::Reading& r = file.readings[0];
  EXPECT_EQ(r.time(), "2025-03-14T09:26:53.5+01:00");
  EXPECT_EQ(r.placement(), "left");
  EXPECT_EQ(r.target(), "T1");
  EXPECT_EQ(r.group(), "a");
  EXPECT_EQ(r.axis().y(), 0.6);
  EXPECT_EQ(r.axis().z(), 0.8);
  EXPECT_EQ(r.temperature_c(), 21.5);
  EXPECT_THAT(r.joint_torques_nm(), ElementsAre(3, -4));
  EXPECT_FALSE(r.has_position_m());
}

// Catches: a zero in the place of what was not measured.
TEST(SessionFileTest, EmptyCellsAreNotMeasured) {
  const SessionFile file = Parse(
      "q1_rad,q2_rad,q1_cmd_rad,q2_cmd_rad,x_mm,y_mm,z_mm,qx,qy,qz,qw,temp_C,time\n"
      "0,1,,,,,,0,0,0,1,,\n"
      ",,0,1,1,2,3,,,,,20,\n");
  ASSERT_EQ(file.readings.size(), 2);
  EXPECT_FALSE(file.readings[0].has_position_m());
  EXPECT_FALSE(file.readings[0].has_temperature_c());
  EXPECT_THAT(file.readings[0].joints_commanded(), IsEmpty());
  EXPECT_TRUE(file.readings[1].has_position_m());
  EXPECT_FALSE(file.readings[1].has_orientation());
  EXPECT_THAT(file.readings[1].joints_measured(), IsEmpty());
}

TEST(SessionFileTest, ReadsSemicolonsWithDecimalCommaBehindAByteOrderMark) {
  const SessionFile file =
      Parse("\xEF\xBB\xBFq1_rad;q2_deg;x_mm;y_mm;z_mm\r\n0,5;90;1,5;2,5;-3,5\r\n");
  ASSERT_EQ(file.readings.size(), 1);
  EXPECT_EQ(file.readings[0].joints_measured(0), 0.5);
  EXPECT_EQ(file.readings[0].position_m().z(), -0.0035);
}

// Catches: an unknown column that is dropped, or that nobody is told about.
TEST(SessionFileTest, KeepsAndListsUnknownColumns) {
  const SessionFile file = Parse("hole,q1_rad,q2_rad,goal_x_m,time_s\n0,1,2,\"a,b\",0.5\n");
  EXPECT_THAT(file.session.extra_columns(), ElementsAre("hole", "goal_x_m", "time_s"));
  ASSERT_EQ(file.readings.size(), 1);
  EXPECT_THAT(file.readings[0].extra_values(), ElementsAre("0", "a,b", "0.5"));
  EXPECT_THAT(
      file.warnings,
      ElementsAre("folder/s.csv: columns that are kept but not used: hole, goal_x_m, time_s"));
}

// Catches: a warning of a column that another option names, and one that hides the others.
TEST(SessionFileTest, ColumnsInUseAreNotCalledUnused) {
  const auto file = ParseSessionFile("hole,q1_rad,q2_rad,time_s\n0,1,2,0.5\n", "s.csv",
                                     RobotOf("RR"), {"", {"hole"}});
  ASSERT_TRUE(file.ok()) << file.status();
  EXPECT_THAT(file->warnings, ElementsAre("s.csv: columns that are kept but not used: time_s"));
  EXPECT_THAT(file->session.extra_columns(), ElementsAre("hole", "time_s"));
}

// Catches: a repeated log line that counts twice, rows numbered with gaps after it.
TEST(SessionFileTest, KeepsRowsThatAreEqualInEveryColumnOnce) {
  const SessionFile file = Parse("q1_rad,q2_rad,note\n1,2,a\n1,2,b\n 1,2,a\n3,4,a\n1,2,b\n");
  ASSERT_EQ(file.readings.size(), 3);
  EXPECT_EQ(file.readings[2].row(), 2);
  EXPECT_EQ(file.readings[2].joints_measured(0), 3);
  ASSERT_EQ(file.warnings.size(), 2);
  EXPECT_EQ(
      file.warnings[1],
      "folder/s.csv: rows equal in every column are kept once: line 4 as line 2, line 6 as line 3");
}

// Catches: a real repeat, another measurement at the same joints, that is thrown away.
TEST(SessionFileTest, KeepsEqualJointsWithAnotherMeasurement) {
  const SessionFile file = Parse("q1_rad,q2_rad,x_mm,y_mm,z_mm\n1,2,3,4,5\n1,2,3,4,5.001\n");
  EXPECT_EQ(file.readings.size(), 2);
  EXPECT_THAT(file.warnings, IsEmpty());
}

TEST(SessionFileTest, ShowsTheFirstOfManyRepeats) {
  std::string text = "q1_rad,q2_rad\n";
  for (int i = 0; i < 31; ++i) text += "1,2\n";
  const SessionFile file = Parse(text);
  EXPECT_EQ(file.readings.size(), 1);
  ASSERT_EQ(file.warnings.size(), 1);
  EXPECT_THAT(file.warnings[0], ::testing::EndsWith("line 22 as line 2 and 10 more"));
}

TEST(SessionFileTest, NamesAMissingFile) {
  const auto result = ReadSessionFile("no/such.csv", RobotOf("R"));
  EXPECT_EQ(result.status().code(), absl::StatusCode::kNotFound);
  EXPECT_THAT(Faults(result),
              ElementsAre("no/such.csv: found no such file, expected a readable file"));
}

}  // namespace
}  // namespace truepose::formats
