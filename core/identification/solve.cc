#include "core/identification/solve.h"

#include "core/identification/kalman.h"
#include "core/identification/levenberg_marquardt.h"
#include "core/identification/linear_iteration.h"
#include "core/identification/simplex.h"

namespace truepose {
namespace {

SolveSummary NothingToDo(const Problem& problem, const ModelError& model_error,
                         const Estimate& estimate) {
  SolveSummary summary;
  summary.termination = Termination::kConverged;
  summary.initial_cost = summary.final_cost =
      CostOf(problem, estimate, WhitenersOf(problem, estimate, model_error));
  return summary;
}

auto FunctionOf(Estimator estimator) {
  switch (estimator) {
    case Estimator::kLevenbergMarquardt:
      break;
    case Estimator::kLinearIteration:
      return &IterateLinearly;
    case Estimator::kKalman:
      return &FilterKalman;
    case Estimator::kSimplex:
      return &SearchBySimplex;
  }
  return &Minimise;
}

}  // namespace

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
  if (active.empty()) return NothingToDo(problem, model_error, *estimate);
  return FunctionOf(options.estimator)(problem, model_error, active, options, hooks, estimate);
}

}  // namespace truepose
