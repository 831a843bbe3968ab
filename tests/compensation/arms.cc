#include "tests/compensation/arms.h"

#include <cstdlib>
#include <iostream>
#include <numbers>

#include "core/compensation/arm_from.h"
#include "tests/core/testing/models.h"

namespace truepose::testing {

compensation::Arm ArmOf(const Robot& robot, const Model& model, const Eigen::VectorXd& lambda) {
  auto arm = ArmFrom(robot, model, lambda);
  if (!arm.ok()) {
    std::cerr << arm.status() << "\n";
    std::abort();
  }
  return *arm;
}

NamedArm WithErrors(const std::string& name, const Robot& robot, double size, uint64_t seed) {
  Random random(seed);
  const Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  const Eigen::VectorXd lambda = RandomVector(model.parameters.size(), size, &random);
  return {name, robot, model, lambda, ArmOf(robot, model, lambda)};
}

std::vector<NamedArm> AllArms() {
  std::vector<NamedArm> arms;
  uint64_t seed = 100;
  for (const NamedRobot& named : AllRobots())
    arms.push_back(WithErrors(named.name, named.robot, 1e-3, ++seed));
  return arms;
}

NamedArm Ur10Arm(double size, uint64_t seed) {
  NamedArm named = WithErrors("UR10", Ur10(), size, seed);
  for (int i = 0; i < 6; ++i) named.arm.limits[i] = {-2 * std::numbers::pi, 2 * std::numbers::pi};
  return named;
}

}  // namespace truepose::testing
