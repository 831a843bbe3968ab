// What a drift check is asked, and what it answers.
//
// Model of the check readings, about the active calibration:
//   r = J_x x + J_d d + e + n,   x ~ N(0, C),   e + n ~ N(0, S)
// r measured minus predicted; x: what the calibration leaves uncertain of base, tool and internal
// parameters, with its covariance C; d: what has changed; n: stated noise; e: unexplained residual,
// correlated between neighbouring poses (error_field.h). Frames that may have moved legitimately
// are free (no prior) and no part of d.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/assessment/statistics.h"
#include "core/identification/weights.h"
#include "core/robot/robot.h"

namespace truepose {

struct DriftProblem {
  const Robot* robot = nullptr;  // not owned
  Problem check;                 // the check's readings; its prior has no part
  // Lambda as calibrated, X_MB and X_FT as calibrated where they are held; of the others any pose.
  Estimate active;
  std::vector<bool> base_held, tool_held;  // one a placement, one a target
  // Of the check's candidates (problem.h), SI; zero rows for those that were not identified and
  // for frames that are not held.
  Eigen::MatrixXd covariance;
  ModelError model_error;  // the calibration's unexplained residual
  // Measured values beyond parameters that it was estimated from; 0 = it is sure.
  int redundancy = 0;
  std::optional<Pose> X_FT_nominal;  // start value of a target that is not held
};

struct DriftPart {
  std::string name;       // "joint 3", "base or joint 1", "tool or last joint"
  double chi_square = 0;  // drop of the whole when this part may have changed
  int degrees_of_freedom = 0;
  double p_value = 1;  // of that drop if nothing has changed
  // Best-fit change of the frame that the part carries: of a revolute joint its offset, of base and
  // tool the motion of B in M and of T in F (of several that which moved most).
  double change_m = 0;
  double change_rad = 0;
  double bic = 0;  // less is likelier
};

struct DriftCheckResult {
  int poses = 0;          // readings that were judged
  Statistics position_m;  // under the calibration, frames fitted where they are not held
  double chi_square = 0;  // of all of them, against C and S
  int degrees_of_freedom = 0;
  double p_value = 1;               // drift_tests.h
  bool changed = false;             // p_value below 0.01
  std::string attributed_to;        // name of a part, or of two: "joint 2 and joint 5"; "" none
  std::vector<DriftPart> together;  // those two with their changes alone; empty of one part
  std::vector<DriftPart> parts;     // likeliest first
  bool base_observable = false, tool_observable = false;
  std::vector<std::string> findings;  // sentences
};

}  // namespace truepose
