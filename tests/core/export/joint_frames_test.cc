// Frames on the axes: the robot of their constant poses moves as the model does.
#include "core/export/joint_frames.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using testing::CountedRobot;
using testing::RandomVector;

Pose JointMotion(JointType type, double q) {
  Pose X;
  Apply(type == JointType::kRevolute ? Motion::kRotation : Motion::kTranslation, Axis::kZ, q, &X);
  return X;
}

Pose Product(const std::vector<Pose>& between, const Home& home, const Eigen::VectorXd& q) {
  Pose X;
  for (size_t i = 0; i < home.axes.size(); ++i)
    X = X * between[i] * JointMotion(home.axes[i].type, q(i));
  return X * between.back();
}

// Would catch an axis read off the sweep wrongly for any kind of robot, a frame beside its axis, a
// wrong order of poses; with C and B_0 also base and flange that are on no axis.
TEST(JointFrames, MoveAsTheModelDoes) {
  Random random(5);
  for (const CountedRobot& counted : testing::CountedRobots()) {
    SCOPED_TRACE(counted.name);
    const Model model = ModifiedIncremental(counted.robot, ModelExtent::kComplete);
    const Eigen::VectorXd lambda = RandomVector(model.parameters.size(), 0.02, &random);
    const auto home = HomeOf(counted.robot, model, lambda, JointSense::kChain);
    ASSERT_TRUE(home.ok());
    const std::vector<Pose> between = PosesBetween(FramesAlong(*home), home->X_BF);
    for (int i = 0; i < 50; ++i) {
      const Eigen::VectorXd q = RandomVector(counted.robot.joint_count(), 3, &random);
      const Pose a = Product(between, *home, q), b = Forward(model, q, lambda);
      // Rounding of some 40 products over a few metres.
      EXPECT_LT((a.p - b.p).norm(), 1e-13);
      EXPECT_LT((a.R - b.R).norm(), 1e-13);
    }
  }
}

// A model with a tilt (Eq. 23), whose third angle is no parameter of its own: would catch axes read
// off the chain alone instead of the model.
TEST(JointFrames, TiltsAreInThePoses) {
  const Robot robot = testing::Ur10();
  Model model;
  model.joint_map = robot.joint_map();
  for (const char* name : {"theta_x", "theta_y"})
    model.parameters.Add({name, ParameterGroup::kInternal, ParameterRole::kAngle, Unit::kRadian});
  model.chain = {{Motion::kRotation, Axis::kX, 0, -1, 1},
                 {Motion::kRotation, Axis::kY, 0, -1, 0},
                 {Motion::kRotation, Axis::kZ, 0, -1, 2}};
  model.tilts = {{0, 1, 2}};
  for (const ElementaryTransform& element : robot.chain()) model.chain.push_back(element);
  const Eigen::VectorXd lambda = Eigen::Vector2d(0.2, -0.3);
  const auto home = HomeOf(robot, model, lambda, JointSense::kChain);
  ASSERT_TRUE(home.ok());
  EXPECT_LT((home->axes[0].u - Eigen::Vector3d(0.2, -0.3, std::sqrt(1 - 0.13))).norm(), 1e-15);
  const std::vector<Pose> between = PosesBetween(FramesAlong(*home), home->X_BF);
  Random random(3);
  const Eigen::VectorXd q = RandomVector(6, 3, &random);
  EXPECT_LT((Product(between, *home, q).p - Forward(model, q, lambda).p).norm(), 1e-14);
}

// Would catch origins that run away along nearly parallel axes, as those of common normals do.
TEST(JointFrames, StayNearTheRobot) {
  const Robot robot = testing::Ur10();
  const Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  Random random(6);
  const auto home = HomeOf(robot, model, RandomVector(model.parameters.size(), 1e-3, &random),
                           JointSense::kChain);
  for (const Pose& X : FramesAlong(*home)) EXPECT_LT(X.p.norm(), 1.3);
}

// URDF's fixed-axis angles, also where pitch is a quarter turn: a division or an asin there would
// lose half of the digits.
TEST(JointFrames, RollPitchYawAreExactEverywhere) {
  Random random(7);
  const double quarter = std::numbers::pi / 2;
  for (int i = 0; i < 300; ++i) {
    const double roll = random.Uniform(-3, 3), yaw = random.Uniform(-3, 3);
    const double pitch = i % 3 == 0   ? quarter
                         : i % 3 == 1 ? -quarter + 1e-9 * random.Uniform()
                                      : random.Uniform(-3, 3);
    Chain chain = {Rotation(Axis::kZ, yaw), Rotation(Axis::kY, pitch), Rotation(Axis::kX, roll)};
    const Eigen::Matrix3d R = Forward<double>(chain, nullptr, nullptr).R;
    const RollPitchYaw angles = RollPitchYawOf(R);
    chain = {Rotation(Axis::kZ, angles.yaw), Rotation(Axis::kY, angles.pitch),
             Rotation(Axis::kX, angles.roll)};
    // A few last bits of numbers below 1.
    EXPECT_LT((Forward<double>(chain, nullptr, nullptr).R - R).norm(), 2e-15);
  }
}

}  // namespace
}  // namespace truepose
