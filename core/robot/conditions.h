// What was the case when a reading was taken, beside the joints: inputs of joint effects.
#pragma once

#include <Eigen/Core>

namespace truepose {

struct Conditions {
  Eigen::VectorXd joint_torque;  // a value a controller joint, N m or N; empty where unknown
  double temperature_K = 0;      // above the session's reference temperature
};

}  // namespace truepose
