// Sessions of a robot whose errors are known: for demonstrations, tests and trying out a
// measurement plan.
#pragma once

#include <cstdint>
#include <vector>

#include "core/identification/problem.h"
#include "core/robot/robot.h"

namespace truepose {

// Standard deviations of one normal draw each; m, rad.
struct SimulateOptions {
  int poses = 100;
  uint64_t seed = 1;
  double length_error_sd_m = 5e-4;
  double angle_error_sd_rad = 5e-4;
  double position_noise_sd_m = 5e-5;    // per axis of M
  double rotation_noise_sd_rad = 1e-4;  // per axis of M
  double joint_noise_sd = 0;            // rad or m, on controller readings
  double encoder_resolution =
      0;  // rad or m; readings are rounded to multiples of it, 0 = not at all
  double joint_range_rad =
      1.5;  // joints are drawn uniformly within +- this of the middle of their limits
  double prismatic_range_m = 0.3;
};

struct SimulatedReading {
  Eigen::VectorXd q_controller;  // as read
  Pose X_MT;                     // as measured
};

struct SimulatedSession {
  std::vector<SimulatedReading> readings;
  Eigen::VectorXd lambda;  // true internal parameters of the model, all candidates
  Pose X_MB, X_FT;         // true frames
};

// @param model of extent kInternal. Draws errors, frames, then poses, in this order, so that a
// change of noise leaves
//   the robot as it is. @param X_FT target on the flange.
SimulatedSession Simulate(const Robot& robot, const Model& model, const Pose& X_FT,
                          const SimulateOptions& options);

}  // namespace truepose
