#include "tests/core/compensation/drawn_arm.h"

#include <gtest/gtest.h>

#include <utility>

#include "core/base/random.h"
#include "core/compensation/arm_from.h"
#include "tests/core/testing/robots.h"

namespace truepose::testing {

compensation::Arm DrawnArm(const Robot& robot, uint64_t seed, double length_sd_m,
                           double angle_sd_rad) {
  const Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  Random random(seed);
  Eigen::VectorXd lambda(model.parameters.size());
  for (int i = 0; i < lambda.size(); ++i)
    lambda(i) =
        random.Normal() * (model.parameters[i].unit == Unit::kMetre ? length_sd_m : angle_sd_rad);
  const auto arm = ArmFrom(robot, model, lambda);
  EXPECT_TRUE(arm.ok()) << arm.status();
  return arm.ok() ? *arm : compensation::Arm();
}

Robot WithLimits(const Robot& robot, double revolute, double prismatic) {
  std::vector<Joint> joints = robot.joints();
  for (Joint& joint : joints) {
    joint.upper = joint.type == JointType::kRevolute ? revolute : prismatic;
    joint.lower = -joint.upper;
  }
  auto limited = Robot::Create(joints, robot.chain(), robot.joint_map(), robot.masses());
  EXPECT_TRUE(limited.ok()) << limited.status();
  return *std::move(limited);
}

Robot Scara() {
  return DhRobot({{0, .3, .25, 0}, {0, 0, .2, 0}, {0, .1, 0, 0}, {0, .05, 0, 0}}, "RRPR");
}

}  // namespace truepose::testing
