#include "core/identification/solve.h"

#include "core/identification/levenberg_marquardt.h"

namespace truepose {

const char* Name(Termination termination) {
  switch (termination) {
    case Termination::kConverged:
      return "converged";
    case Termination::kIterationLimit:
      return "iteration_limit";
    case Termination::kCancelled:
      return "cancelled";
    case Termination::kFailed:
      break;
  }
  return "failed";
}

const char* Name(Estimator estimator) {
  switch (estimator) {
    case Estimator::kLevenbergMarquardt:
      return "levenberg_marquardt";
    case Estimator::kLinearIteration:
      return "linear_iteration";
    case Estimator::kKalman:
      return "kalman";
    case Estimator::kSimplex:
      break;
  }
  return "simplex";
}

SolveSummary Solve(const Problem& problem, const ModelError& model_error,
                   const std::vector<int>& active, const SolveOptions& options, const Hooks& hooks,
                   Estimate* estimate) {
  return Minimise(problem, model_error, active, options, hooks, estimate);
}

}  // namespace truepose
