#include "formats/targets_file.h"

#include <numbers>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/formats/samples.h"

namespace truepose::formats {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Targets = std::vector<v1::CompensationTarget>;

absl::StatusOr<Targets> Parse(std::string_view text, std::string_view joints = "RP") {
  return ParseTargetsFile(text, "t.csv", RobotOf(joints));
}

TEST(TargetsFileTest, ReadsJoints) {
  const Targets targets = ValueOf(Parse("name,q1_deg,q2_mm\nhome,180,250\nhome,180,250\n"));
  ASSERT_EQ(targets.size(), 2);
  EXPECT_THAT(targets[0].joints(), ElementsAre(std::numbers::pi, 0.25));
  EXPECT_FALSE(targets[0].has_pose());
  EXPECT_EQ(targets[1].row(), 1);
}

// Catches: a pose whose quaternion has the other sign than messages carry, or lengths in mm.
TEST(TargetsFileTest, ReadsPoses) {
  const Targets targets = ValueOf(Parse("x_mm,y_mm,z_mm,qx,qy,qz,qw\n1,2,-3,0,0,0.8,-0.6\n"));
  ASSERT_EQ(targets.size(), 1);
  EXPECT_THAT(targets[0].joints(), IsEmpty());
  EXPECT_EQ(targets[0].pose().z_m(), -0.003);
  EXPECT_EQ(targets[0].pose().qz(), -0.8);
  EXPECT_EQ(targets[0].pose().qw(), 0.6);
}

TEST(TargetsFileTest, ReadsPosesWithAConfiguration) {
  const Targets targets =
      ValueOf(Parse("q1_rad,q2_m,x_m,y_m,z_m,qx,qy,qz,qw\n1,2,0,0,0,0,0,0,1\n1,2,,,,,,,\n"));
  ASSERT_EQ(targets.size(), 2);
  EXPECT_TRUE(targets[0].has_pose());
  EXPECT_THAT(targets[0].joints(), ElementsAre(1, 2));
  EXPECT_FALSE(targets[1].has_pose());
}

TEST(TargetsFileTest, NamesWhatIsNoTarget) {
  EXPECT_THAT(Faults(Parse("a,b\n1,2\n")),
              ElementsAre("t.csv:1: found no column of a target, expected q1_rad..., or "
                          "x_mm,y_mm,z_mm,qx,qy,qz,qw, or both"));
  EXPECT_THAT(
      Faults(Parse("x_mm,y_mm,z_mm\n1,2,far\n")),
      ElementsAre("t.csv:1: found x,y,z without qx,qy,qz,qw, expected position and orientation "
                  "of a pose",
                  "t.csv:2: z_mm: found 'far', expected a number"));
  EXPECT_THAT(Faults(Parse("note,q1_rad,q2_m\nx,,\n")),
              ElementsAre("t.csv:2: target: found empty cells, expected joints or a pose"));
  EXPECT_THAT(Faults(Parse("q1_rad,q2_m,q1_cmd_rad,q2_cmd_m\n1,2,3,4\n")),
              ElementsAre("t.csv:1: q1_cmd_rad: found a commanded joint, expected the joints of a "
                          "target without _cmd, such as q1_rad"));
}

TEST(TargetsFileTest, NamesFaultsOfRows) {
  EXPECT_THAT(
      Faults(Parse("q1_rad,q2_m,x_m,y_m,z_m,qx,qy,qz,qw\n"
                   "1,,0,0,0,0,0,0,1\n"
                   "1,2,0,0,0,,,,\n"
                   "1,2,0,0,0,0,0,0,2\n")),
      ElementsAre("t.csv:2: q2_m: found an empty cell, expected a number, as q1_rad has one",
                  "t.csv:3: qx,qy,qz,qw: found empty cells, expected position and orientation "
                  "of a pose",
                  "t.csv:4: qx,qy,qz,qw: found a length of 2, expected 1 within 0.001"));
}

TEST(TargetsFileTest, NamesAFileWithoutTargets) {
  EXPECT_THAT(Faults(Parse("q1_rad,q2_m\n")),
              ElementsAre("t.csv: found no rows under the header, expected at least one target"));
}

v1::CompensateResponse SomeResponse() {
  v1::CompensateResponse response;
  v1::CompensatedTarget* good = response.add_targets();
  good->add_joints(0.1);
  good->add_joints(1.0 / 3);
  good->mutable_pose()->set_x_m(0.5001234567);
  good->mutable_pose()->set_qw(1);
  good->set_position_correction_mm(0.75);
  good->set_rotation_correction_deg(0.01);
  good->set_residual_position_mm(1e-10);
  v1::CompensatedTarget* bad = response.add_targets();
  bad->set_row(1);
  bad->set_fault("out of reach, 3 mm");
  return response;
}

// Catches: a result whose columns a controller's program would take in another order or unit.
TEST(TargetsFileTest, WritesResults) {
  EXPECT_EQ(
      WriteCompensatedTargets(RobotOf("RP"), SomeResponse()),
      "row,q1_rad,q2_m,x_mm,y_mm,z_mm,qx,qy,qz,qw,position_correction_mm,"
      "rotation_correction_deg,residual_position_mm,fault\n"
      "0,0.1,0.3333333333333333,500.123457,0.000000,0.000000,0,0,0,1,0.750000,0.010000,1e-10,\n"
      "1,,,,,,,,,,,,,\"out of reach, 3 mm\"\n");
}

TEST(TargetsFileTest, ResultsWithoutFaultsReadBackAsTargets) {
  v1::CompensateResponse response = SomeResponse();
  response.mutable_targets()->RemoveLast();
  const Targets targets = ValueOf(Parse(WriteCompensatedTargets(RobotOf("RP"), response)));
  ASSERT_EQ(targets.size(), 1);
  EXPECT_EQ(targets[0].joints(1), 1.0 / 3);
  EXPECT_NEAR(targets[0].pose().x_m(), 0.5001234567, 1e-9);
}

}  // namespace
}  // namespace truepose::formats
