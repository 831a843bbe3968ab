// Exact compensation: joints at which the *identified* internal chain puts the flange where the
// nominal one would.
//
// Newton on X_BF(q, lambda) = X_BF_desired, from B to F only: base, target, production tools and
// work frames are not touched. With 6 joints of full rank the step solves the square system; with
// more the smallest step of least squares is taken, with fewer the least-squares fit, whose
// remainder is reported and not hidden.
#pragma once

#include <Eigen/Core>

#include "absl/status/statusor.h"
#include "core/models/model.h"
#include "core/robot/robot.h"

namespace truepose {

struct CompensationOptions {
  int max_iterations = 20;
  // Steps below this end the iteration: 1e-13 m or rad is far below any encoder.
  double step_tolerance = 1e-13;
  // A remainder above these is a target that the robot can't reach exactly; only for robots with 6
  // or more joints.
  double position_tolerance_m = 1e-9;
  double rotation_tolerance_rad = 1e-9;
};

struct Compensated {
  Eigen::VectorXd q;  // chain joints
  int iterations = 0;
  double position_residual_m = 0;  // |p_BF reached - desired|
  double rotation_residual_rad = 0;
};

// @param model extent kInternal; lambda its parameters. @param q_start chain joints near the
// answer.
// @returns kFailedPrecondition when Newton does not converge (near a singularity, or out of reach),
// saying which.
absl::StatusOr<Compensated> SolvePose(const Model& model, const Eigen::VectorXd& lambda,
                                      const Pose& X_BF_desired, const Eigen::VectorXd& q_start,
                                      const CompensationOptions& options);

// The joints that put the identified flange where the nominal flange is at q_target (both chain
// joints).
absl::StatusOr<Compensated> CompensateJoints(const Model& model, const Eigen::VectorXd& lambda,
                                             const Eigen::VectorXd& q_target,
                                             const CompensationOptions& options);

// Chain joints at which the *nominal* flange is at X_BF: by Newton from `preferred`, and where that
// does not arrive from seeded draws over the joint limits, until 12 of at most 100 have arrived
// within the limits; of these the one nearest to `preferred`.
// @param robot its nominal; @param preferred controller joints, e.g. the middle of the limits.
// @returns kFailedPrecondition when no start arrives.
absl::StatusOr<Eigen::VectorXd> NominalInverse(const Robot& robot, const Model& model,
                                               const Pose& X_BF, const Eigen::VectorXd& preferred,
                                               const CompensationOptions& options);

}  // namespace truepose
