// Coordinates of tables.
#include "core/compensation/table_axes.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/base/random.h"
#include "core/compensation/arm_from.h"
#include "tests/core/compensation/drawn_arm.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using compensation::Arm;

// Samples of a UR10 whose forearm turns back what upper arm and elbow turn.
std::vector<JointVector> ToolDownSamples(Random* random) {
  std::vector<JointVector> samples;
  for (int i = 0; i < 100; ++i) {
    JointVector q = testing::RandomVector(6, 1, random);
    q(3) = -1.6 - q(1) - q(2) + random->Uniform(-0.3, 0.3);
    samples.push_back(q);
  }
  return samples;
}

// E5: would catch sums of joints whose axes are not parallel, or the wide one kept.
TEST(TableAxes, OfAnElbowArmHaveTheSumOfItsParallelJoints) {
  Random random(1);
  const Arm arm = testing::DrawnArm(testing::Ur10(), 1);
  const JointMatrix W = WeightOfSamples(arm, ToolDownSamples(&random));
  Eigen::MatrixXd expected = Eigen::MatrixXd::Identity(6, 6);
  expected.row(3) << 0, 1, 1, 1, 0, 0;
  EXPECT_EQ(W, expected);
}

// Would catch a sum taken without the direction of an axis that points the other way.
TEST(TableAxes, CountOppositeAxesNegative) {
  const double r = 90 * testing::kDeg;
  // Axes 2 and 3 opposite to each other.
  const Robot robot = testing::DhRobot({{0, .3, 0, r}, {0, 0, .4, 2 * r}, {0, 0, .3, 0}}, "RRR");
  const Arm arm = testing::DrawnArm(robot, 1);
  Random random(2);
  std::vector<JointVector> samples;
  for (int i = 0; i < 50; ++i) {
    JointVector q = testing::RandomVector(3, 1, &random);
    q(2) = q(1) + random.Uniform(-0.1, 0.1);
    samples.push_back(q);
  }
  const JointMatrix W = WeightOfSamples(arm, samples);
  EXPECT_EQ(std::abs(W(2, 1)), 1);
  EXPECT_EQ(W(2, 1), -W(2, 2));
}

// A sliding joint turns nothing: the first and last joint of a SCARA stay parallel over it. Would
// catch a group that ends at one.
TEST(TableAxes, LookPastSlidingJoints) {
  const Arm arm = testing::DrawnArm(testing::Scara(), 1);
  Random random(3);
  std::vector<JointVector> samples;
  for (int i = 0; i < 50; ++i) {
    JointVector q = testing::RandomVector(4, 0.8, &random);
    q(3) = -q(0) - q(1) + random.Uniform(-0.05, 0.05);
    samples.push_back(q);
  }
  const JointMatrix W = WeightOfSamples(arm, samples);
  EXPECT_EQ(W.row(3), Eigen::RowVector4d(1, 1, 0, 1));
  EXPECT_TRUE(TableAxes(arm, W).IsLength(2));
  EXPECT_FALSE(TableAxes(arm, W).IsLength(3));
}

// J3 = J2 + J3, a reversed joint and offsets: would catch a box of controller joints that is not
// one of coordinates, or a map that does not come back.
TEST(TableAxes, TurnABoxOfControllerJointsIntoOne) {
  const Robot plain = testing::Ur10();
  JointMap map = JointMap::Identity(6);
  map.scale(2, 1) = 1;
  map.scale(0, 0) = -1;
  map.offset << 0.1, -0.2, 0.3, 0, 0.5, 0;
  const auto robot = Robot::Create(plain.joints(), plain.chain(), map);
  ASSERT_TRUE(robot.ok()) << robot.status();
  const Arm arm = testing::DrawnArm(*robot, 1);
  const TableAxes axes(arm, WeightOfControllerJoints(arm));
  std::vector<compensation::JointLimits> ranges;
  for (int i = 0; i < 6; ++i) ranges.push_back({-0.1 * (i + 1), 0.2 * (i + 1)});
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(axes.Hull(k, ranges).width(), 0.3 * (k + 1), 1e-15) << k;
  Random random(4);
  const JointVector q = testing::RandomVector(6, 1, &random);
  EXPECT_LT((axes.ToController(axes.FromController(q)) - q).norm(), 1e-15);
  EXPECT_LT((axes.FromChain(robot->joint_map().ToChain(q)) - axes.FromController(q)).norm(), 1e-15);
}

}  // namespace
}  // namespace truepose
