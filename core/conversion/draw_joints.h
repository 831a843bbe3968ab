// Joints anywhere in a robot's ranges.
#pragma once

#include <Eigen/Core>

#include "core/base/random.h"
#include "core/robot/robot.h"

namespace truepose {

// Chain joints of one configuration, uniform between the limits of the controller's joints; where a
// limit is missing, half a turn or 0.5 m from the middle.
Eigen::VectorXd DrawJoints(const Robot& robot, Random* random);

}  // namespace truepose
