#include "core/calibrate/joint_sources.h"

#include <algorithm>
#include <utility>

#include "core/base/status_macros.h"

namespace truepose {
namespace {

// The problem with the other joints, and for each calibration reading whether it has any.
struct OtherJoints {
  Problem problem;
  std::vector<bool> has;
};

OtherJoints TakeOthers(const CalibrationProblem& whole, const Problem& used) {
  OtherJoints other{used, {}};
  for (size_t i = 0; i < whole.readings.size(); ++i) {
    if (!whole.calibrates[i]) continue;
    const bool has = whole.other_q[i].size() > 0;
    if (has) other.problem.readings[other.has.size()].q = whole.other_q[i];
    other.has.push_back(has);
  }
  return other;
}

void TakeWeights(const std::vector<double>& weights, Problem* problem) {
  for (size_t i = 0; i < problem->readings.size() && i < weights.size(); ++i)
    problem->readings[i].weight = weights[i];
}

double RmsPosition(const Problem& problem, const std::vector<bool>& chosen,
                   const Estimate& estimate) {
  const std::vector<PoseError> errors = PoseErrors(problem, estimate);
  std::vector<double> sizes;
  for (size_t i = 0; i < errors.size(); ++i) {
    if (chosen[i]) sizes.push_back(errors[i].position_m);
  }
  return StatisticsOf(sizes).rms;
}

// The least-squares fit of the same parameters; nullopt where it fails.
absl::StatusOr<std::optional<Estimate>> Refit(const Problem& problem, const Identification& result,
                                              const Hooks& hooks) {
  Estimate estimate = result.estimate;
  const SolveSummary summary =
      Solve(problem, result.model_error, result.set.active, SolveOptions{}, hooks, &estimate);
  if (summary.termination == Termination::kCancelled) return absl::CancelledError("cancelled");
  if (summary.termination == Termination::kFailed) return std::optional<Estimate>();
  return std::optional<Estimate>(std::move(estimate));
}

}  // namespace

absl::StatusOr<std::optional<JointComparison>> CompareJointSources(const CalibrationProblem& whole,
                                                                   const Part& part,
                                                                   Estimator estimator,
                                                                   const Identification& result,
                                                                   const Hooks& hooks) {
  const std::optional<JointComparison> none;
  if (whole.other_q.empty()) return none;
  Problem used = part.problem;
  TakeWeights(result.weights, &used);
  const OtherJoints other = TakeOthers(whole, used);
  const auto count = static_cast<int>(std::count(other.has.begin(), other.has.end(), true));
  if (count == 0) return none;
  std::optional<Estimate> with_used = result.estimate;
  // Levenberg-Marquardt has left nothing to gain; the others may have.
  if (estimator != Estimator::kLevenbergMarquardt) {
    TRUEPOSE_ASSIGN_OR_RETURN(with_used, Refit(used, result, hooks));
  }
  TRUEPOSE_ASSIGN_OR_RETURN(const std::optional<Estimate> with_other,
                            Refit(other.problem, result, hooks));
  if (!with_used || !with_other) return none;
  return std::optional<JointComparison>({count, RmsPosition(used, other.has, *with_used),
                                         RmsPosition(other.problem, other.has, *with_other)});
}

}  // namespace truepose
