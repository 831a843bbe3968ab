// The robots and targets that the project comes with.
#include <array>
#include <cmath>
#include <numbers>

#include "formats/fixture_file.h"
#include "formats/robot_file.h"
#include "formats/targets_file.h"
#include "gmock/gmock.h"
#include "google/protobuf/util/message_differencer.h"
#include "gtest/gtest.h"
#include "tests/formats/samples.h"

namespace truepose::formats {
namespace {

RobotFile Example(const std::string& name) {
  return ValueOf(ReadRobotFile(TRUEPOSE_SOURCE_DIR "/deploy/examples/" + name));
}

// The rows theta, d, a, alpha of a table, in deg and mm.
using Rows = std::vector<std::array<double, 4>>;

Rows RowsOf(const v1::DhTable& table) {
  const auto deg = [](double rad) { return rad / std::numbers::pi * 180; };
  Rows rows;
  for (const v1::DhRow& row : table.rows()) {
    rows.push_back(
        {deg(row.theta_rad()), row.d_m() * 1000, row.a_m() * 1000, deg(row.alpha_rad())});
  }
  return rows;
}

void ExpectRows(const v1::DhTable& table, const Rows& expected) {
  const Rows rows = RowsOf(table);
  ASSERT_EQ(rows.size(), expected.size());
  for (size_t i = 0; i < rows.size(); ++i) {
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(rows[i][k], expected[i][k], 1e-9) << i << " " << k;
  }
}

// Catches: a mistyped data sheet value, which would be identified as an error of every robot.
TEST(ExampleFilesTest, Ur10) {
  const RobotFile ur10 = Example("ur10.yaml");
  EXPECT_EQ(ur10.robot_id, "ur10");
  ExpectRows(ur10.nominal.geometry().standard_dh(), {{0, 127.3, 0, 90},
                                                     {0, 0, -612, 0},
                                                     {0, 0, -572.3, 0},
                                                     {0, 163.941, 0, 90},
                                                     {0, 115.7, 0, -90},
                                                     {0, 92.2, 0, 0}});
  ASSERT_EQ(ur10.nominal.tools_size(), 1);
  EXPECT_EQ(ur10.nominal.tools(0).name(), "tracker_target");
  EXPECT_EQ(ur10.nominal.tools(0).pose().z_m(), 0.109);
}

TEST(ExampleFilesTest, FrankaPanda) {
  const v1::Nominal panda = Example("franka_panda.yaml").nominal;
  ExpectRows(panda.geometry().craig_dh(), {{0, 333, 0, 0},
                                           {0, 0, 0, -90},
                                           {0, 316, 0, 90},
                                           {0, 0, 82.5, 90},
                                           {0, 384, -82.5, -90},
                                           {0, 0, 0, 90},
                                           {0, 0, 88, 90}});
  ASSERT_EQ(panda.geometry().flange_size(), 1);
  EXPECT_EQ(panda.geometry().flange(0).constant(), 0.107);
  ASSERT_EQ(panda.tools_size(), 1);
  EXPECT_EQ(panda.tools(0).pose().qz(), -std::sin(std::numbers::pi / 8));
  EXPECT_EQ(panda.joints(5).upper(), 3.7525);
}

TEST(ExampleFilesTest, StanfordArm) {
  const v1::Nominal arm = Example("stanford.yaml").nominal;
  ExpectRows(arm.geometry().standard_dh(), {{0, 412, 0, 90},
                                            {0, 154, 0, 90},
                                            {0, 0, 0, 0},
                                            {0, 0, 0, -90},
                                            {0, 0, 0, 90},
                                            {0, 263, 0, 0}});
  EXPECT_EQ(arm.joints(2).type(), v1::PRISMATIC);
  EXPECT_EQ(arm.joints(2).lower(), 0.25);
  EXPECT_EQ(arm.joints(2).upper(), 0.65);
}

TEST(ExampleFilesTest, MeasuringRobot) {
  const v1::Nominal arm = Example("measuring_robot.yaml").nominal;
  EXPECT_EQ(arm.kind(), v1::MEASURING);
  ExpectRows(arm.geometry().standard_dh(),
             {{0, 252, 0, 90}, {0, 0, 320, 0}, {90, 0, 0, 90}, {0, 330, 0, 90}, {-90, 0, 0, 90}});
  ASSERT_EQ(arm.tools_size(), 1);
  EXPECT_EQ(arm.tools(0).pose().z_m(), 0.161);
}

TEST(ExampleFilesTest, EveryExampleReadsBack) {
  for (const char* name :
       {"ur10.yaml", "franka_panda.yaml", "stanford.yaml", "measuring_robot.yaml"}) {
    const RobotFile file = Example(name);
    const RobotFile again = ValueOf(ParseRobotFile(WriteRobotFile(file), name));
    EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(again.nominal, file.nominal))
        << name;
  }
}

// Catches: a dime whose features do not stand where its drawing says, and the sockets of a golden
// test.
TEST(ExampleFilesTest, Fixtures) {
  const auto read = [](const std::string& name) {
    return ValueOf(ReadFixtureFile(TRUEPOSE_SOURCE_DIR "/deploy/examples/" + name)).fixture;
  };
  const v1::Fixture sockets = read("sockets.yaml");
  ASSERT_EQ(sockets.features_size(), 2);
  EXPECT_EQ(sockets.features(1).name(), "1");
  EXPECT_EQ(sockets.features(1).pose().x_m(), 0.05);
  EXPECT_EQ(std::sqrt(sockets.features(1).covariance(0)), 0.02e-3);
  const v1::Fixture dime = read("dime.yaml");
  ASSERT_EQ(dime.features_size(), 6);
  EXPECT_EQ(dime.features(2).kind(), v1::FEATURE_POINT_AXIS);
  for (const v1::Fixture& fixture : {sockets, dime}) {
    const v1::Fixture again =
        ValueOf(ParseFixtureFile(WriteFixtureFile(fixture), fixture.name())).fixture;
    EXPECT_TRUE(google::protobuf::util::MessageDifferencer::Equals(again, fixture))
        << WriteFixtureFile(fixture);
  }
}

TEST(ExampleFilesTest, Targets) {
  for (const char* robot : {"ur10", "measuring_robot"}) {
    const v1::Nominal nominal = Example(std::string(robot) + ".yaml").nominal;
    const std::string path =
        std::string(TRUEPOSE_SOURCE_DIR "/deploy/examples/") + robot + "_targets.csv";
    EXPECT_EQ(ValueOf(ReadTargetsFile(path, nominal)).size(), 10) << path;
  }
}

}  // namespace
}  // namespace truepose::formats
