#include "core/identification/linear_iteration.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "core/identification/weighted_problem.h"

namespace truepose {
namespace {

constexpr double kStableDecrease = 1e-12;  // of the cost
constexpr double kStableStep_sd = 1e-7;    // reached first where the readings are exact
constexpr double kDivergedBy = 10;         // times the least cost

// Where the iteration stands, and the best that it has seen.
struct Iterate {
  Eigen::VectorXd x, best;
  double cost = 0, least = 0;
};

bool IsStable(const LinearStep& step, double cost) {
  return step.decrease <= std::max(kStableDecrease * cost, kStableStep_sd * kStableStep_sd / 2);
}

SolveSummary Failed(SolveSummary summary, std::string message) {
  summary.termination = Termination::kFailed;
  summary.message = std::move(message);
  return summary;
}

void Move(const WeightedProblem& problem, const Eigen::VectorXd& step, Iterate* at) {
  at->x += step;
  at->cost = problem.Cost(at->x);
  if (!(at->cost < at->least)) return;
  at->least = at->cost;
  at->best = at->x;
}

SolveSummary RunIteration(const WeightedProblem& problem, const SolveOptions& options,
                          const Hooks& hooks, Iterate* at) {
  SolveSummary summary;
  summary.initial_cost = at->cost;
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
  while (summary.iterations < options.max_iterations) {
    if (hooks.Cancelled()) {
      summary.termination = Termination::kCancelled;
      return summary;
    }
    problem.Linearise(at->x, &r, &J);
    const LinearStep step = SolveLinear(r, J);
    if (!step.determined) return Failed(summary, "the readings do not determine the parameters");
    const bool stable = IsStable(step, at->cost);
    Move(problem, step.x, at);
    hooks.Report({"identification", 0, ++summary.iterations, at->cost});
    if (stable) {
      summary.termination = Termination::kConverged;
      return summary;
    }
    if (!(at->cost <= kDivergedBy * at->least)) {
      return Failed(summary, absl::StrCat("diverged: iteration ", summary.iterations,
                                          " raised the cost from ", at->least, " to ", at->cost));
    }
  }
  summary.termination = Termination::kIterationLimit;
  return summary;
}

}  // namespace

SolveSummary IterateLinearly(const Problem& problem, const ModelError& model_error,
                             const std::vector<int>& active, const SolveOptions& options,
                             const Hooks& hooks, Estimate* estimate) {
  const Estimate start = *estimate;
  const WeightedProblem weighted(problem, model_error, active, start);
  Iterate at{weighted.Start(), weighted.Start(), 0, 0};
  at.cost = at.least = weighted.Cost(at.x);
  if (!std::isfinite(at.cost)) return Failed({}, "a residual at the start is not finite");
  SolveSummary summary = RunIteration(weighted, options, hooks, &at);
  summary.final_cost = at.least;
  const bool usable = summary.termination == Termination::kConverged ||
                      summary.termination == Termination::kIterationLimit;
  if (usable) *estimate = weighted.At(at.best);
  return summary;
}

}  // namespace truepose
