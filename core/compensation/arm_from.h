// The runtime's picture (compensation/arm.h) of a robot and what was identified of it.
#pragma once

#include "absl/status/statusor.h"
#include "compensation/arm.h"
#include "core/models/model.h"
#include "core/robot/robot.h"

namespace truepose {

// Constant elements between two joints are merged into one pose and every joint is turned into one
// about or along z: a joint along u is u = Q z with Q a permutation of the axes, so its constants
// take Q and Q^T. Parameters are folded into the constants, tilts included. The nominal flange is
// the robot's, the identified one Forward(model, q, lambda) at the reference temperature, loads
// those of gravity; both to rounding.
// @param model internal or complete, of this robot; @param lambda its parameters.
// @returns kInvalidArgument with the faults `robot.joints` (more than 12), `robot.masses` (more
// than 16 where compliance is identified), `lambda` (another number than the model's, or not
// finite).
absl::StatusOr<compensation::Arm> ArmFrom(const Robot& robot, const Model& model,
                                          const Eigen::VectorXd& lambda);

}  // namespace truepose
