#include "core/identification/identify.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/identification/prediction.h"

namespace truepose {
namespace {

double RelativeChange(double a, double b) { return std::abs(a - b) / std::max(a, b); }

bool Stands(const ModelError& a, const ModelError& b, double tolerance) {
  return RelativeChange(a.position_sd_m, b.position_sd_m) < tolerance &&
         RelativeChange(a.rotation_sd_rad, b.rotation_sd_rad) < tolerance;
}

void Accumulate(const SolveSummary& round, SolveSummary* total) {
  const bool first = total->iterations == 0;
  const double initial = first ? round.initial_cost : total->initial_cost;
  const int iterations = total->iterations + round.iterations;
  *total = round;
  total->initial_cost = initial;
  total->iterations = iterations;
}

// Solves and re-weights in turn until the weights stand; the last solve used the weights that are
// returned.
absl::Status SolveWithWeights(const Problem& problem, const std::vector<int>& active,
                              const IdentifyOptions& options, const Hooks& hooks,
                              Identification* result) {
  for (int round = 0; round < options.max_weight_rounds; ++round) {
    Accumulate(Solve(problem, result->model_error, active, options.solve, hooks, &result->estimate),
               &result->summary);
    if (result->summary.termination == Termination::kCancelled)
      return absl::CancelledError("cancelled");
    if (result->summary.termination == Termination::kFailed) return absl::OkStatus();
    const ModelError next =
        EstimateModelError(problem, result->estimate, active, result->model_error);
    if (Stands(next, result->model_error, options.weight_tolerance)) return absl::OkStatus();
    if (round + 1 == options.max_weight_rounds) break;
    result->model_error = next;
  }
  result->summary.termination = Termination::kIterationLimit;
  result->summary.message = "the estimated model error did not settle";
  return absl::OkStatus();
}

IdentifiableSet ExternalSet(const Eigen::MatrixXd& J, const Problem& problem,
                            IdentifiabilityOptions options) {
  ParameterSet external;
  const ParameterSet all = Candidates(problem);
  for (int i = 0; i < problem.FirstInternal(); ++i) external.Add(all[i]);
  options.use_sd_bounds = false;
  return Identifiable(J.leftCols(problem.FirstInternal()), external, options);
}

// (J'J)^-1 of the active columns, by QR of the columns scaled to norm 1.
Eigen::MatrixXd ParameterCovariance(const Eigen::MatrixXd& J, const std::vector<int>& active) {
  Eigen::MatrixXd columns = J(Eigen::all, active);
  const Eigen::VectorXd scale = columns.colwise().norm().cwiseInverse();
  columns = columns * scale.asDiagonal();
  const Eigen::Index n = columns.cols();
  const Eigen::MatrixXd R = Eigen::HouseholderQR<Eigen::MatrixXd>(columns).matrixQR().topRows(n);
  const Eigen::MatrixXd inverse =
      R.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(n, n));
  return scale.asDiagonal() * (inverse * inverse.transpose()) * scale.asDiagonal();
}

void Finish(const Problem& problem, Identification* result) {
  const WhitenedSystem system = Whitened(problem, result->estimate, result->model_error);
  result->rows = static_cast<int>(system.r.size());
  const int redundancy = result->rows - static_cast<int>(result->set.active.size());
  const double sum = system.r.squaredNorm();
  result->weighted_residual_variance = redundancy > 0 ? sum / redundancy : 0;
  result->summary.final_cost = sum / 2;
  if (result->rows >= static_cast<int>(result->set.active.size())) {
    result->covariance = ParameterCovariance(system.J, result->set.active);
  }
}

// Whether a candidate is a base correction of a placement that is known by contact only.
bool IsFreeByContact(const Problem& problem, int candidate) {
  if (candidate >= problem.FirstOfTool(0)) return false;
  const int placement = candidate / kFrameParameters;
  return std::all_of(problem.readings.begin(), problem.readings.end(),
                     [&](const Reading& r) { return r.placement != placement || r.contact; });
}

// Whether other readings of the same sort could not determine the candidate either.
bool IsStructural(const Problem& problem, const IdentifiableSet& generic, int candidate) {
  return !std::binary_search(generic.active.begin(), generic.active.end(), candidate) ||
         IsFreeByContact(problem, candidate);
}

void MarkStructural(const Problem& problem, const IdentifiableSet& generic, IdentifiableSet* set) {
  for (NullRelation& relation : set->redundancies) {
    relation.structural =
        !relation.undetermined && IsStructural(problem, generic, relation.dropped);
  }
}

// Always at nominal lambda: there the model's own redundancies are exact. At identified parameters
// two nominally parallel axes are a milliradian apart, a redundant parameter looks independent, and
// the basis that keeps it in place of a strong one is worse conditioned by a factor of 1,000 (UR10:
// 15,000 against 50).
IdentifiableSet SetAtNominal(const Problem& problem, const Identification& before,
                             const ModelError& model_error, const IdentifiabilityOptions& options) {
  return Identifiable(Whitened(problem, before.estimate, model_error).J, Candidates(problem),
                      options);
}

// Parameters that are no longer active go back to nominal.
void ResetInactive(const Problem& problem, const std::vector<int>& active, Estimate* estimate) {
  const std::set<int> kept(active.begin(), active.end());
  for (Eigen::Index i = 0; i < estimate->lambda.size(); ++i) {
    if (!kept.contains(problem.FirstInternal() + static_cast<int>(i))) estimate->lambda(i) = 0;
  }
}

// What stays of `active` when looked at again: a candidate that was dropped never comes back, so
// the set only shrinks.
IdentifiableSet Shrunk(const IdentifiableSet& again, const std::vector<int>& active) {
  IdentifiableSet set = again;
  set.active.clear();
  std::set_intersection(again.active.begin(), again.active.end(), active.begin(), active.end(),
                        std::back_inserter(set.active));
  for (int candidate : again.active) {
    if (!std::binary_search(active.begin(), active.end(), candidate)) {
      set.redundancies.push_back({candidate, {}, true, false});
    }
  }
  return set;
}

// Solves for the kept candidates, then looks again with the weights found, until none proves too
// weak: the set that is returned is one that was solved. Ends, since the set shrinks each time.
absl::Status SolveKept(const Problem& problem, const Identification& before,
                       const IdentifyOptions& options, const Hooks& hooks, Identification* result) {
  for (;;) {
    TRUEPOSE_RETURN_IF_ERROR(SolveWithWeights(problem, result->set.active, options, hooks, result));
    if (result->summary.termination == Termination::kFailed) return absl::OkStatus();
    IdentifiableSet again =
        Shrunk(SetAtNominal(problem, before, result->model_error, options.identifiability),
               result->set.active);
    result->set.condition = again.condition;
    if (again.active.size() == result->set.active.size()) return absl::OkStatus();
    result->set = std::move(again);
    ResetInactive(problem, result->set.active, &result->estimate);
  }
}

}  // namespace

absl::Status CheckFrames(const Problem& problem, const IdentifiableSet& generic,
                         const IdentifiableSet& actual) {
  const ParameterSet names = Candidates(problem);
  FaultList faults;
  for (const NullRelation& relation : actual.redundancies) {
    if (relation.dropped >= problem.FirstInternal() ||
        IsStructural(problem, generic, relation.dropped))
      continue;
    faults.Add(names[relation.dropped].name,
               absl::StrCat("not determined by ", problem.readings.size(),
                            " readings: ", RelationText(relation, names)),
               "readings with more, and more different, positions and orientations of the flange");
  }
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

absl::StatusOr<Identification> FitFrames(const Problem& problem, const Estimate& start,
                                         const IdentifyOptions& options, const Hooks& hooks) {
  Identification result;
  result.estimate = start;
  result.set =
      ExternalSet(Whitened(problem, start, result.model_error).J, problem, options.identifiability);
  TRUEPOSE_RETURN_IF_ERROR(SolveWithWeights(problem, result.set.active, options, hooks, &result));
  Finish(problem, &result);
  return result;
}

absl::StatusOr<Identification> Identify(const Problem& problem, const IdentifiableSet& generic,
                                        const Identification& before,
                                        const IdentifyOptions& options, const Hooks& hooks) {
  Identification result;
  result.estimate = before.estimate;
  result.model_error = before.model_error;
  IdentifiabilityOptions dependence_only = options.identifiability;
  dependence_only.use_sd_bounds =
      false;  // the weights of "before" are those of an uncalibrated robot
  result.set = SetAtNominal(problem, before, before.model_error, dependence_only);
  TRUEPOSE_RETURN_IF_ERROR(CheckFrames(problem, generic, result.set));
  TRUEPOSE_RETURN_IF_ERROR(SolveKept(problem, before, options, hooks, &result));
  MarkStructural(problem, generic, &result.set);
  Finish(problem, &result);
  return result;
}

}  // namespace truepose
