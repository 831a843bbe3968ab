// The geometry of a robot by its axes: what a model with its parameter values is, without its
// parameters.
//
// With all joints at zero the sweep of the model gives each joint's screw in B and X_BF, and by the
// product of exponentials
//   X_BF(q) = exp(S_1 q_1) ... exp(S_n q_n) X_BF(0),
// so the n axes and X_BF(0) say all of the robot's motion, whatever its model is. What is made of
// them (frames, D&H rows) is exact up to rounding.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "absl/status/statusor.h"
#include "core/geometry/pose.h"
#include "core/models/model.h"
#include "core/robot/robot.h"

namespace truepose {

// In B, with all joints at zero.
struct JointAxis {
  JointType type = JointType::kRevolute;
  Eigen::Vector3d u;  // unit vector; positive joint values turn about or move along it
  Eigen::Vector3d p;  // m, the point of a revolute axis nearest to B's origin; 0 for a prismatic
                      // joint, which has a direction only
};

struct Home {
  std::vector<JointAxis> axes;
  Pose X_BF;
};

// Whose zeros and signs the axes have.
enum class JointSense {
  kChain,       // the chain's joints; the joint map stays beside the result
  kController,  // the controller's readings; the joint map is in the result
};

// @param lambda the model's parameters.
// @returns kInvalidArgument with a fault of
//   `effects`, for each joint effect whose parameter is not 0: a geometry can't hold it, and
//     without it the other parameters, which were identified beside it, are not the best geometry;
//   `joint_map.scale`, for kController, unless the map is diagonal with 1 or -1.
absl::StatusOr<Home> HomeOf(const Robot& robot, const Model& model, const Eigen::VectorXd& lambda,
                            JointSense sense);

}  // namespace truepose
