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

struct SolveOptions {
  Estimator estimator = Estimator::kLevenbergMarquardt;
  int max_iterations = 100;
  // Relative decrease of the cost that counts as converged. 1e-14 is near the last bit of the sum,
  // so that two ways to the same minimum agree in their parameters to about 1e-7 of a standard
  // deviation.
  double function_tolerance = 1e-14;
  double parameter_tolerance = 1e-14;  // relative step
};

struct SolveSummary {
  Termination termination = Termination::kFailed;
  int iterations = 0;
  double initial_cost = 0;  // half the weighted sum of squares
  double final_cost = 0;
  std::string message;
};

// Minimises 1/2 sum |W_h r_h|^2 + 1/2 |prior|^2 over the active candidates by the estimator of the
// options; the others keep their value. W_h are the whiteners of the readings at the start.
// @param estimate start on entry, the result on return; on kCancelled and kFailed it is left as it
// was.
SolveSummary Solve(const Problem& problem, const ModelError& model_error,
                   const std::vector<int>& active, const SolveOptions& options, const Hooks& hooks,
                   Estimate* estimate);

}  // namespace truepose
