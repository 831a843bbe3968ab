#include "core/conversion/draw_joints.h"

#include <cmath>
#include <numbers>

namespace truepose {

Eigen::VectorXd DrawJoints(const Robot& robot, Random* random) {
  Eigen::VectorXd q = robot.MiddleOfLimits();
  for (int i = 0; i < robot.joint_count(); ++i) {
    const Joint& joint = robot.joints()[i];
    const double half = joint.type == JointType::kRevolute ? std::numbers::pi : 0.5;
    q(i) = random->Uniform(std::isfinite(joint.lower) ? joint.lower : q(i) - half,
                           std::isfinite(joint.upper) ? joint.upper : q(i) + half);
  }
  return robot.joint_map().ToChain(q);
}

}  // namespace truepose
