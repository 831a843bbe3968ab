// What every estimator is given and gives back: one problem, one result.
#pragma once

#include <string>

#include "core/base/hooks.h"
#include "core/identification/problem.h"
#include "core/identification/weights.h"

namespace truepose {

enum class Termination { kConverged, kIterationLimit, kCancelled, kFailed };

const char* Name(Termination termination);

enum class Estimator { kLevenbergMarquardt, kLinearIteration, kKalman, kSimplex };

// "levenberg_marquardt", "linear_iteration", "kalman", "simplex".
const char* Name(Estimator estimator);

// Of the Kalman filter (kalman.h). P_0 is diagonal: what a parameter may be off at the start, by
// its role and unit. An unscaled P_0 lets the first readings throw the estimate far off
// (chapter-notes 19); one that is narrow against the true errors pulls the result to the start.
struct KalmanOptions {
  int passes = 2;                  // 1: the covariance is approximate
  double length_sd_m = 3e-3;       // of the geometry
  double angle_sd_rad = 0.0175;    // 1 deg
  double frame_length_sd_m = 0.1;  // base and tool, constants of distances
  double frame_angle_sd_rad = 0.175;
  double ratio_sd = 1e-2;  // gains
  double compliance_sd_rad_per_nm = 1e-4;
  double compliance_sd_m_per_n = 1e-6;
  double drift_sd_rad_per_k = 1e-4;
  double drift_sd_m_per_k = 1e-4;
};

enum class SimplexObjective {
  kLeastSquares,       // the cost that the other estimators minimise
  kMeanPositionError,  // the chapter's E_op: another problem with another minimum
};

// Of the simplex (simplex.h).
struct SimplexOptions {
  SimplexObjective objective = SimplexObjective::kLeastSquares;
  int max_evaluations = 5'000;  // of all restarts together
};

struct SolveOptions {
  Estimator estimator = Estimator::kLevenbergMarquardt;
  int max_iterations = 100;  // of Levenberg-Marquardt and of linear iteration
  // Relative decrease of the cost that counts as converged. 1e-14 is near the last bit of the sum,
  // so that two ways to the same minimum agree in their parameters to about 1e-7 of a standard
  // deviation. This and the next are Levenberg-Marquardt's.
  double function_tolerance = 1e-14;
  double parameter_tolerance = 1e-14;  // relative step
  KalmanOptions kalman = {};
  SimplexOptions simplex = {};
};

struct SolveSummary {
  Termination termination = Termination::kFailed;
  int iterations = 0;       // steps; passes of the Kalman filter
  int evaluations = 0;      // of the objective, by the simplex
  double initial_cost = 0;  // half the weighted sum of squares
  double final_cost = 0;
  std::string message;
  bool covariance_approximate = false;  // one pass of the Kalman filter
  // The filter's own covariance of the active candidates, in their order, P_0 included; SI. Empty
  // for the other estimators.
  Eigen::MatrixXd covariance = {};
};

// Minimises 1/2 sum |W_h r_h|^2 + 1/2 |prior|^2 over the active candidates by the estimator of the
// options; the others keep their value. W_h are the whiteners of the readings at the start. All
// estimators end in the same minimum; how each ends and fails stands in its header. Without an
// active candidate there is nothing to do, which is converged.
// @param estimate start on entry, the result on return; on kCancelled and kFailed it is left as it
// was.
SolveSummary Solve(const Problem& problem, const ModelError& model_error,
                   const std::vector<int>& active, const SolveOptions& options, const Hooks& hooks,
                   Estimate* estimate);

}  // namespace truepose
