// Arms that tests of the runtime share.
#pragma once

#include <string>
#include <vector>

#include "compensation/arm.h"
#include "core/models/model.h"
#include "core/robot/robot.h"
#include "tests/core/testing/robots.h"

namespace truepose::testing {

struct NamedArm {
  std::string name;
  Robot robot;
  Model model;  // modified incremental, internal
  Eigen::VectorXd lambda;
  compensation::Arm arm;
};

// ArmFrom that must succeed.
compensation::Arm ArmOf(const Robot& robot, const Model& model, const Eigen::VectorXd& lambda);

// The robot with random errors of its geometry, uniform within +-size (rad, m), seeded.
NamedArm WithErrors(const std::string& name, const Robot& robot, double size, uint64_t seed);

// AllRobots (the counted ones, the measuring arm, awkward axes) with errors of 1 mrad and 1 mm:
// what a robot has before it is calibrated.
std::vector<NamedArm> AllArms();

// UR10 with the joint limits of its data sheet's +-360 deg.
NamedArm Ur10Arm(double size, uint64_t seed);

}  // namespace truepose::testing
