// The runtime's arm is the robot and the model that it was made of.
#include "core/compensation/arm_from.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compensation/kinematics.h"
#include "core/base/fault.h"
#include "tests/core/testing/models.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

// Lengths of metres and some thirty products: 1e-14 by rounding, a lost element shows as 1e-3.
constexpr double kSame = 1e-12;

void ExpectSame(const Pose& a, const Pose& b, const std::string& what) {
  EXPECT_LT((a.p - b.p).norm(), kSame) << what;
  EXPECT_LT((a.R - b.R).norm(), kSame) << what;
}

void ExpectSameFlanges(const Robot& robot, const Model& model, const Eigen::VectorXd& lambda,
                       const std::string& what) {
  const auto arm = ArmFrom(robot, model, lambda);
  ASSERT_TRUE(arm.ok()) << arm.status();
  Random random(5);
  for (int draw = 0; draw < 10; ++draw) {
    const Eigen::VectorXd q = testing::RandomVector(robot.joint_count(), 2.5, &random);
    ExpectSame(compensation::NominalFlange(*arm, q.data()), NominalForward(robot, q), what);
    ExpectSame(compensation::IdentifiedFlange(*arm, q.data()),
               Forward(model, robot.joint_map().ToChain(q), lambda), what);
  }
}

// An axis turned the wrong way, an element lost between two joints, a parameter that moves instead
// of its constant, a tilt taken for an angle.
TEST(ArmFrom, EveryRobotAndModel) {
  for (const testing::NamedRobot& named : testing::AllRobots()) {
    for (const std::string& kind : ModelKinds()) {
      auto model = BuildModel(kind, named.robot, ModelExtent::kInternal);
      if (!model.ok()) continue;  // the incremental models of one joint
      Random random(7);
      ExpectSameFlanges(named.robot, *model,
                        testing::RandomVector(model->parameters.size(), 0.05, &random),
                        named.name + " " + kind);
    }
  }
}

TEST(ArmFrom, CompleteModelsHaveTheirBaseAndGripper) {
  for (const std::string& kind : ModelKinds()) {
    const Robot robot = testing::Panda();
    const Model model = testing::ModelOf(kind, robot, ModelExtent::kComplete);
    Random random(8);
    ExpectSameFlanges(robot, model, testing::RandomVector(model.parameters.size(), 0.05, &random),
                      kind);
  }
}

Robot Coupled(const Robot& robot, std::vector<LinkMass> masses) {
  JointMap map = JointMap::Identity(robot.joint_count());
  map.scale(2, 1) = 1;   // J3 = J2 + J3
  map.scale(4, 4) = -1;  // sign
  map.offset(0) = 0.3;
  auto coupled = Robot::Create(robot.joints(), robot.chain(), map, std::move(masses));
  EXPECT_TRUE(coupled.ok()) << coupled.status();
  return *coupled;
}

// Effects act on controller joints, before the map; loads are those of the nominal chain, brought
// to the controller's joints by the transposed map.
TEST(ArmFrom, EffectsOfACoupledRobotWithMasses) {
  const Robot robots[] = {
      Coupled(testing::Ur10(), {{1, 9, {0.2, 0.1, 0.3}}, {4, 3, {0.7, 0, 0.2}}}),
      Coupled(testing::Stanford(), {{2, 5, {0.1, 0.2, 0.5}}})};
  for (const Robot& robot : robots) {
    Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
    for (EffectGroup group : AllEffectGroups()) AddEffects(robot, group, &model);
    Random random(9);
    Eigen::VectorXd lambda = testing::RandomVector(model.parameters.size(), 0.01, &random);
    for (const JointEffect& effect : model.effects) {
      if (effect.kind == EffectKind::kTorque) lambda(effect.parameter) *= 1e-2;  // of some 100 N m
    }
    ExpectSameFlanges(robot, model, lambda, "coupled");
  }
}

TEST(ArmFrom, LimitsAreTheControllers) {
  Robot ur10 = testing::Ur10();
  std::vector<Joint> joints = ur10.joints();
  joints[3].lower = -1.5;
  joints[3].upper = 2.5;
  const Robot robot = *Robot::Create(joints, ur10.chain(), JointMap::Identity(6));
  const Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  const auto arm = ArmFrom(robot, model, Eigen::VectorXd::Zero(model.parameters.size()));
  ASSERT_TRUE(arm.ok());
  EXPECT_EQ(arm->limits[3].lower, -1.5);
  EXPECT_EQ(arm->limits[3].upper, 2.5);
  EXPECT_TRUE(std::isinf(arm->limits[0].upper));
}

Robot LongArm(int joints) {
  return testing::DhRobot(std::vector<DhRow>(joints, {0, 0.1, 0.1, 0.5}), std::string(joints, 'R'));
}

// All faults at once, with what was found and expected.
TEST(ArmFrom, FaultsAreNamed) {
  const Robot robot = LongArm(13);
  Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  model.masses.resize(17);
  std::vector<std::string> fields;
  for (const Fault& fault : FaultsOf(ArmFrom(robot, model, Eigen::VectorXd::Zero(2)).status()))
    fields.push_back(fault.field + ": " + fault.found);
  EXPECT_THAT(fields,
              ::testing::ElementsAre("robot.joints: 13", "robot.masses: 17", "lambda: 2 values"));
}

TEST(ArmFrom, TwelveJointsAreTaken) {
  const Robot robot = LongArm(12);
  const Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  Random random(3);
  ExpectSameFlanges(robot, model, testing::RandomVector(model.parameters.size(), 0.01, &random),
                    "12R");
}

}  // namespace
}  // namespace truepose
