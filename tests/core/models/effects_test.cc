#include "core/models/effects.h"

#include <gtest/gtest.h>

#include "core/models/model.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

Model WithAllEffects(const Robot& robot) {
  Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  for (EffectGroup group : AllEffectGroups()) AddEffects(robot, group, &model);
  return model;
}

Conditions Loaded(Random* random) {
  return {testing::RandomVector(6, 50, random), random->Uniform(-10, 10)};
}

// d pose / d lambda of every parameter, effects included, against central differences: a column
// that goes to the wrong joint or forgets the joint map.
TEST(Effects, JacobianIsTheDerivative) {
  Random random(11);
  const Robot coupled = [] {
    const Robot plain = testing::Ur10();
    JointMap map = JointMap::Identity(6);
    map.scale(2, 1) = 1;  // J3 = J2 + J3
    map.scale(4, 4) = -1;
    map.offset(3) = 0.2;
    return Robot::Create(plain.joints(), plain.chain(), map).value();
  }();
  const Model model = WithAllEffects(coupled);
  const Eigen::VectorXd q = testing::RandomVector(6, 1.5, &random);
  Eigen::VectorXd lambda = testing::RandomVector(model.parameters.size(), 1e-3, &random);
  const Conditions conditions = Loaded(&random);
  ModelSweep sweep;
  RunSweep(model, q.data(), lambda.data(), conditions, &sweep);
  for (int k = 0; k < model.parameters.size(); ++k) {
    const double h = 1e-6, value = lambda(k);
    lambda(k) = value + h;
    const Pose plus = Forward(model, q, lambda, conditions);
    lambda(k) = value - h;
    const Pose minus = Forward(model, q, lambda, conditions);
    lambda(k) = value;
    const Eigen::Vector3d v = (plus.p - minus.p) / (2 * h);
    const Eigen::Vector3d w = LogRotation<double>(plus.R * minus.R.transpose()) / (2 * h);
    const Eigen::Matrix<double, 6, 1> twist = TwistAt(sweep.X_BF.p, sweep.J_parameters.col(k));
    // A regressor of up to 50 N m scales what the difference rounds off.
    EXPECT_LT((twist.head<3>() - v).norm(), 5e-7) << model.parameters[k].name;
    EXPECT_LT((twist.tail<3>() - w).norm(), 5e-7) << model.parameters[k].name;
  }
}

// A gain of 1e-3 at 2 rad is an offset of 2 mrad; what a reading means must not depend on the way.
TEST(Effects, GainIsAnOffsetThatGrows) {
  const Robot robot = testing::Ur10();
  Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  AddEffects(robot, EffectGroup::kGain, &model);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(6);
  q(2) = 2;
  Eigen::VectorXd gain = Eigen::VectorXd::Zero(model.parameters.size()), offset = gain;
  gain(*model.parameters.Find("gain3")) = 1e-3;
  offset(*model.parameters.Find("dq3")) = 2e-3;
  EXPECT_LT((Forward(model, q, gain).p - Forward(model, q, offset).p).norm(), 1e-15);
}

// Without measured torques those of gravity take their place; without masses there are none.
TEST(Effects, ComplianceTakesGravityWhereNothingWasMeasured) {
  const Robot plain = testing::Ur10();
  const Robot heavy =
      Robot::Create(plain.joints(), plain.chain(), plain.joint_map(), {{1, 10, {-1, 0, 0.1273}}})
          .value();
  Model model = ModifiedIncremental(heavy, ModelExtent::kInternal);
  AddEffects(heavy, EffectGroup::kCompliance, &model);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(6);
  EXPECT_NEAR(std::abs(TorqueOf(model, zero, {})(1)), 98.0665, 1e-9);
  const Conditions measured{Eigen::VectorXd::Constant(6, 3.0), 0};
  EXPECT_EQ(TorqueOf(model, zero, measured)(1), 3);
  Model light = ModifiedIncremental(plain, ModelExtent::kInternal);
  AddEffects(plain, EffectGroup::kCompliance, &light);
  EXPECT_EQ(TorqueOf(light, zero, {}).size(), 0);
}

TEST(Effects, SlidingJointsHaveNoHarmonics) {
  const Robot robot = testing::Stanford();
  Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  AddEffects(robot, EffectGroup::kHarmonic1, &model);
  EXPECT_FALSE(model.parameters.Find("harmonic1_cos3"));
  EXPECT_TRUE(model.parameters.Find("harmonic1_sin4"));
  EXPECT_EQ(model.effects.size(), 10u);
}

}  // namespace
}  // namespace truepose
