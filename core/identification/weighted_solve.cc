#include "core/identification/weighted_solve.h"

#include <algorithm>
#include <cmath>

namespace truepose {
namespace {

// Weights that move less than this no longer move parameters by a visible part of their deviation.
constexpr double kWeightStands = 1e-4;

double RelativeChange(double a, double b) { return a == b ? 0 : std::abs(a - b) / std::max(a, b); }

bool Stands(const ModelError& a, const ModelError& b, double tolerance) {
  return RelativeChange(a.position_sd_m, b.position_sd_m) < tolerance &&
         RelativeChange(a.rotation_sd_rad, b.rotation_sd_rad) < tolerance;
}

void Accumulate(const SolveSummary& round, SolveSummary* total) {
  const bool first = total->iterations == 0;
  const double initial = first ? round.initial_cost : total->initial_cost;
  const int iterations = total->iterations + round.iterations,
            evaluations = total->evaluations + round.evaluations;
  *total = round;
  total->initial_cost = initial;
  total->iterations = iterations;
  total->evaluations = evaluations;
}

ModelError NextModelError(const Problem& problem, const std::vector<int>& active,
                          const IdentifyOptions& options, double consistency,
                          const Identification& result) {
  if (options.known_model_error) return *options.known_model_error;
  return EstimateModelError(problem, result.estimate, active, result.model_error, consistency);
}

// One way through the loop with one loss.
absl::Status Loop(Loss loss, const std::vector<int>& active, const IdentifyOptions& options,
                  const Hooks& hooks, Problem* problem, Identification* result) {
  SolveOptions solve = options.solve;
  solve.estimator = Estimator::kLevenbergMarquardt;
  const double consistency = MeanConsistency(loss, *problem);
  for (int round = 0; round < options.max_weight_rounds; ++round) {
    Accumulate(Solve(*problem, result->model_error, active, solve, hooks, &result->estimate),
               &result->summary);
    if (result->summary.termination == Termination::kCancelled)
      return absl::CancelledError("cancelled");
    if (result->summary.termination == Termination::kFailed) return absl::OkStatus();
    const double moved =
        loss == Loss::kNone ? 0 : Reweigh(loss, result->estimate, result->model_error, problem);
    const ModelError next = NextModelError(*problem, active, options, consistency, *result);
    const double tolerance = loss == Loss::kNone ? options.weight_tolerance : kWeightStands;
    if (Stands(next, result->model_error, tolerance) && moved < 100 * kWeightStands)
      return absl::OkStatus();
    if (round + 1 == options.max_weight_rounds) break;
    result->model_error = next;
  }
  result->summary.termination = Termination::kIterationLimit;
  result->summary.message = "the estimated model error did not settle";
  return absl::OkStatus();
}

}  // namespace

double MeanConsistency(Loss loss, const Problem& problem) {
  if (loss == Loss::kNone) return 1;
  double of_rows[7] = {};
  for (int rows = 1; rows <= 6; ++rows) of_rows[rows] = Consistency(loss, rows);
  double sum = 0;
  for (const Reading& reading : problem.readings) sum += of_rows[RowsOf(reading)];
  return sum / static_cast<double>(problem.readings.size());
}

absl::Status SolveWithWeights(const std::vector<int>& active, const IdentifyOptions& options,
                              const Hooks& hooks, Problem* problem, Identification* result) {
  const Estimate start = result->estimate;
  if (options.known_model_error) result->model_error = *options.known_model_error;
  // Tukey's loss has many minima; Huber's has one, near it.
  if (options.loss != Loss::kNone)
    if (auto status = Loop(Loss::kHuber, active, options, hooks, problem, result); !status.ok())
      return status;
  if (options.loss != Loss::kHuber)
    if (auto status = Loop(options.loss, active, options, hooks, problem, result); !status.ok())
      return status;
  if (options.solve.estimator == Estimator::kLevenbergMarquardt ||
      result->summary.termination == Termination::kFailed)
    return absl::OkStatus();
  result->estimate = start;
  result->summary =
      Solve(*problem, result->model_error, active, options.solve, hooks, &result->estimate);
  return result->summary.termination == Termination::kCancelled ? absl::CancelledError("cancelled")
                                                                : absl::OkStatus();
}

}  // namespace truepose
