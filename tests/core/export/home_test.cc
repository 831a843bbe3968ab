// The axes that a model's sweep gives, in the chain's and in the controller's sense.
#include "core/export/home.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/fault.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using ::testing::HasSubstr;
using testing::Ur10;

// Rounding of a few products of lengths below 2 m.
constexpr double kRounding = 1e-14;

Eigen::VectorXd ZeroOf(const Model& model) {
  return Eigen::VectorXd::Zero(model.parameters.size());
}

// Would catch an axis with the wrong sense, a point beside it, a flange that is not at home.
TEST(Home, Ur10ByHand) {
  const Robot robot = Ur10();
  const Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  const auto home = HomeOf(robot, model, ZeroOf(model), JointSense::kChain);
  ASSERT_TRUE(home.ok()) << home.status();
  ASSERT_EQ(home->axes.size(), 6u);
  EXPECT_LT((home->axes[0].u - Eigen::Vector3d(0, 0, 1)).norm(), kRounding);
  EXPECT_LT((home->axes[2].u - Eigen::Vector3d(0, -1, 0)).norm(), kRounding);
  EXPECT_LT((home->axes[2].p - Eigen::Vector3d(-.612, 0, .1273)).norm(), kRounding);
  EXPECT_LT((home->axes[4].u - Eigen::Vector3d(0, 0, -1)).norm(), kRounding);
  EXPECT_LT((home->axes[4].p - Eigen::Vector3d(-1.1843, -.163941, 0)).norm(), kRounding);
  EXPECT_LT((home->X_BF.p - Eigen::Vector3d(-1.1843, -.256141, .0116)).norm(), kRounding);
}

// q_chain = -q + 0.3 at joint 2: would catch a sign or an offset that is lost on the way.
TEST(Home, ControllersSenseHoldsSignsAndOffsets) {
  JointMap map = JointMap::Identity(6);
  map.scale(1, 1) = -1;
  map.offset(1) = 0.3;
  const Robot plain = Ur10();
  const auto robot = Robot::Create(plain.joints(), plain.chain(), map);
  ASSERT_TRUE(robot.ok());
  const Model model = ModifiedIncremental(*robot, ModelExtent::kInternal);
  const auto home = HomeOf(*robot, model, ZeroOf(model), JointSense::kController);
  ASSERT_TRUE(home.ok()) << home.status();
  const Pose X_BF = NominalForward(*robot, Eigen::VectorXd::Zero(6));
  EXPECT_LT((home->X_BF.p - X_BF.p).norm(), kRounding);
  EXPECT_LT((home->axes[1].u - Eigen::Vector3d(0, 1, 0)).norm(), kRounding);
  const auto chain = HomeOf(*robot, model, ZeroOf(model), JointSense::kChain);
  EXPECT_LT((chain->axes[1].u - Eigen::Vector3d(0, -1, 0)).norm(), kRounding);
}

// Would catch a coupled controller that is exported as if its joints were the chain's.
TEST(Home, CoupledJointsHaveNoControllersSense) {
  JointMap map = JointMap::Identity(6);
  map.scale(2, 1) = 1;
  const auto robot = Robot::Create(Ur10().joints(), Ur10().chain(), map);
  const Model model = ModifiedIncremental(*robot, ModelExtent::kInternal);
  EXPECT_TRUE(HomeOf(*robot, model, ZeroOf(model), JointSense::kChain).ok());
  const auto home = HomeOf(*robot, model, ZeroOf(model), JointSense::kController);
  ASSERT_EQ(FaultsOf(home.status()).size(), 1u);
  EXPECT_EQ(FaultsOf(home.status())[0].field, "joint_map.scale");
}

// Would catch effects that are dropped in silence, and effects of size 0 that are in the way.
TEST(Home, EffectsAreRefusedByName) {
  const Robot robot = Ur10();
  Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  AddEffects(robot, EffectGroup::kHarmonic1, &model);
  Eigen::VectorXd lambda = ZeroOf(model);
  EXPECT_TRUE(HomeOf(robot, model, lambda, JointSense::kChain).ok());
  lambda(*model.parameters.Find("harmonic1_cos4")) = 1e-4;
  const auto home = HomeOf(robot, model, lambda, JointSense::kChain);
  ASSERT_EQ(FaultsOf(home.status()).size(), 1u);
  EXPECT_THAT(FaultsOf(home.status())[0].found, HasSubstr("harmonic1_cos4"));
  // One cause is one fault, however many numbers it is.
  for (const JointEffect& effect : model.effects) lambda(effect.parameter) = 1e-4;
  const auto many = HomeOf(robot, model, lambda, JointSense::kChain);
  ASSERT_EQ(FaultsOf(many.status()).size(), 1u);
  EXPECT_THAT(FaultsOf(many.status())[0].found, HasSubstr(" and 9 more"));
}

}  // namespace
}  // namespace truepose
