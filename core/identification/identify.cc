#include "core/identification/identify.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <set>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/identification/contacts.h"
#include "core/identification/fixture_error.h"
#include "core/identification/frame_gauge.h"
#include "core/identification/robust.h"
#include "core/identification/weighted_solve.h"

namespace truepose {
namespace {

// identify.h. 0 when nothing is left over.
double WeightedVariance(const WhitenedSystem& system, int active, double consistency) {
  const double redundancy = consistency * (system.weight.sum() - active);
  return redundancy > 0 ? system.weight.dot(system.r.cwiseAbs2()) / redundancy : 0;
}

VarianceFactor FactorOf(const Problem& problem, const Identification& identification) {
  double sums[2] = {0, 0};
  int rows[2] = {0, 0};
  for (Reading reading : problem.readings) {
    reading.weight = 1;
    const Residual variances =
        CovarianceOf(problem, reading, identification.estimate, identification.model_error)
            .diagonal();
    const int positions = PositionRowsOf(reading), rotations = RotationRowsOf(reading);
    sums[0] += variances.head(positions).sum();
    sums[1] += variances.tail(rotations).sum();
    rows[0] += positions;
    rows[1] += rotations;
  }
  const double factor = identification.weighted_residual_variance;
  const auto sd = [&](int kind) {
    return std::sqrt(factor * sums[kind] / std::max(rows[kind], 1));
  };
  return {factor, {sd(0), sd(1)}};
}

// The parameters' covariance under a loss (robust.h); rows of a prior stay as they are.
Eigen::MatrixXd RobustCovariance(const Problem& problem, Loss loss, const Identification& result) {
  Problem unweighted = problem;
  for (Reading& reading : unweighted.readings) reading.weight = 1;
  WhitenedSystem system = Whitened(unweighted, result.estimate, result.model_error);
  const int active = static_cast<int>(result.set.active.size());
  system.J.topRows(result.rows) /= std::sqrt(
      RobustCovarianceFactor(loss, unweighted, result.estimate, result.model_error, active));
  return ParameterCovariance(system.J, result.set.active);
}

void Finish(const Problem& problem, const IdentifyOptions& options, Identification* result) {
  const WhitenedSystem system = Whitened(problem, result->estimate, result->model_error);
  const int prior_rows = problem.prior ? static_cast<int>(problem.prior->root.rows()) : 0;
  const int active = static_cast<int>(result->set.active.size());
  const int all_rows = static_cast<int>(system.r.size());
  result->rows = all_rows - prior_rows;
  result->weighted_residual_variance =
      WeightedVariance(system, active, MeanConsistency(options.loss, problem));
  result->summary.final_cost = system.r.squaredNorm() / 2;
  result->weights.clear();
  for (const Reading& reading : problem.readings) result->weights.push_back(reading.weight);
  if (result->summary.covariance_approximate) {
    result->covariance = result->summary.covariance;
  } else if (options.loss != Loss::kNone && result->rows > active) {
    result->covariance = RobustCovariance(problem, options.loss, *result);
  } else if (all_rows >= active) {
    result->covariance = ParameterCovariance(system.J, result->set.active);
  }
  if (options.scale_covariance) {
    result->variance_factor = FactorOf(problem, *result);
    result->covariance *= result->variance_factor->value;
  }
  result->fixture_covariance = FixtureCovariance(problem, result->estimate, result->model_error,
                                                 system, result->set.active, result->covariance);
  if (result->fixture_covariance.size() > 0) result->covariance += result->fixture_covariance;
}

// Whether a candidate is a base correction of a placement that is known by contact only.
bool IsFreeByContact(const Problem& problem, int candidate) {
  if (candidate >= problem.FirstOfTool(0)) return false;
  const int placement = candidate / kFrameParameters;
  return std::all_of(problem.readings.begin(), problem.readings.end(),
                     [&](const Reading& r) { return r.placement != placement || r.contact; });
}

// Of the placements known by contact only, those whose every contact is a point.
bool IsOfSockets(const Problem& problem, int candidate) {
  if (!IsFreeByContact(problem, candidate)) return false;
  const int placement = candidate / kFrameParameters;
  return std::all_of(problem.readings.begin(), problem.readings.end(), [&](const Reading& r) {
    return r.placement != placement || PositionRowsOf(r) == 3;
  });
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
    relation.of_sockets = IsOfSockets(problem, relation.dropped);
  }
}

// The columns that may move, and which candidates they are.
struct FreeColumns {
  std::vector<int> candidates;
  ParameterSet names;
};

FreeColumns FreeOf(const Problem& problem, const std::vector<int>& free) {
  const ParameterSet all = Candidates(problem);
  FreeColumns columns{free, {}};
  if (free.empty()) {
    columns.candidates.resize(all.size());
    std::iota(columns.candidates.begin(), columns.candidates.end(), 0);
  }
  for (int candidate : columns.candidates) columns.names.Add(all[candidate]);
  return columns;
}

// From indices of columns back to candidates.
void Renumber(const std::vector<int>& candidates, IdentifiableSet* set) {
  for (int& index : set->active) index = candidates[index];
  for (NullRelation& relation : set->redundancies) {
    relation.dropped = candidates[relation.dropped];
    for (auto& [index, coefficient] : relation.kept) index = candidates[index];
  }
}

// Whether a prior holds geometric parameters, which then can't be too weak.
bool HoldsGeometry(const Problem& problem) {
  if (!problem.prior) return false;
  const ParameterSet& parameters = problem.model->parameters;
  for (int i = 0; i < parameters.size(); ++i) {
    if (parameters[i].role != ParameterRole::kEffect && !problem.prior->root.col(i).isZero(0))
      return true;
  }
  return false;
}

// Always at nominal lambda, at joints where contacts are exact, and by the readings alone: there
// the model's own redundancies are exact. At identified parameters two nominally parallel axes are
// a milliradian apart, a redundant parameter looks independent, and the basis that keeps it in
// place of a strong one is worse conditioned by a factor of 1,000 (UR10: 15,000 against 50). With a
// prior nothing would be redundant, and all would be spread over redundant parameters.
IdentifiableSet SetAtNominal(const Problem& problem, const Identification& before,
                             const ModelError& model_error, const IdentifyOptions& options,
                             bool use_sd_bounds) {
  Estimate nominal = before.estimate;
  nominal.lambda.setZero();
  IdentifiabilityOptions identifiability = options.identifiability;
  identifiability.use_sd_bounds =
      identifiability.use_sd_bounds && use_sd_bounds && !HoldsGeometry(problem);
  const FreeColumns columns = FreeOf(problem, options.free);
  Eigen::MatrixXd J = Whitened(AtContacts(problem, nominal), nominal, model_error).J;
  if (problem.prior) J.bottomRows(problem.prior->root.rows()).setZero();
  IdentifiableSet set =
      Identifiable(J(Eigen::all, columns.candidates), columns.names, identifiability);
  Renumber(columns.candidates, &set);
  return set;
}

// Parameters that are no longer active go back to where they started.
void ResetInactive(const Problem& problem, const std::vector<int>& active,
                   const Eigen::VectorXd& start, Estimate* estimate) {
  const std::set<int> kept(active.begin(), active.end());
  for (Eigen::Index i = 0; i < estimate->lambda.size(); ++i) {
    if (!kept.contains(problem.FirstInternal() + static_cast<int>(i)))
      estimate->lambda(i) = start(i);
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
absl::Status SolveKept(const Identification& before, const IdentifyOptions& options,
                       const Hooks& hooks, Problem* problem, Identification* result) {
  for (;;) {
    TRUEPOSE_RETURN_IF_ERROR(SolveWithWeights(result->set.active, options, hooks, problem, result));
    if (result->summary.termination == Termination::kFailed) return absl::OkStatus();
    IdentifiableSet again = Shrunk(
        SetAtNominal(*problem, before, result->model_error, options, true), result->set.active);
    result->set.condition = again.condition;
    if (again.active.size() == result->set.active.size()) return absl::OkStatus();
    result->set = std::move(again);
    ResetInactive(*problem, result->set.active, before.estimate.lambda, &result->estimate);
  }
}

}  // namespace

bool IsTakenUpByFrames(const Problem& problem, const IdentifiableSet& actual,
                       const NullRelation& relation) {
  // Two poses leave any hand-eye problem open: that is a want of readings, not of motion.
  constexpr size_t kFewestReadings = 3;
  if (problem.readings.size() < kFewestReadings || relation.kept.empty()) return false;
  if (relation.dropped < problem.FirstOfTool(0) || relation.dropped >= problem.FirstOfOffsets())
    return false;
  const int first = relation.dropped - relation.dropped % kFrameParameters;
  const bool moved = std::any_of(actual.active.begin(), actual.active.end(), [&](int candidate) {
    return candidate >= first && candidate < first + kFrameParameters;
  });
  if (!moved) return false;
  return std::all_of(relation.kept.begin(), relation.kept.end(),
                     [&](const auto& term) { return term.first < problem.FirstOfOffsets(); });
}

absl::Status CheckFrames(const Problem& problem, const IdentifiableSet& generic,
                         const IdentifiableSet& actual) {
  const ParameterSet names = Candidates(problem);
  FaultList faults;
  for (const NullRelation& relation : actual.redundancies) {
    if (relation.dropped >= problem.FirstInternal() ||
        IsStructural(problem, generic, relation.dropped) ||
        IsTakenUpByFrames(problem, actual, relation))
      continue;
    faults.Add(names[relation.dropped].name,
               absl::StrCat("not determined by ", problem.readings.size(),
                            " readings: ", RelationText(relation, names)),
               "readings with more, and more different, positions and orientations of the flange");
  }
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

Eigen::MatrixXd ScatterCovariance(const Identification& identification) {
  if (identification.fixture_covariance.size() == 0) return identification.covariance;
  return identification.covariance - identification.fixture_covariance;
}

ModelError UnexplainedOf(const Identification& identification) {
  return identification.variance_factor ? identification.variance_factor->unexplained
                                        : identification.model_error;
}

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

absl::StatusOr<Identification> FitFrames(const Problem& problem, const Estimate& start,
                                         const IdentifyOptions& options, const Hooks& hooks) {
  Problem frames_alone = problem;  // lambda is held, so a prior says nothing
  frames_alone.prior.reset();
  IdentifyOptions direct = options;
  direct.solve.estimator = Estimator::kLevenbergMarquardt;
  Identification result;
  result.estimate = start;
  SetFreeToolsToNominal(frames_alone, options.X_FT_nominal, options.free, options.identifiability,
                        &result.estimate);
  result.set = FrameSet(frames_alone, result.estimate, result.model_error, options.identifiability);
  if (!options.free.empty()) {
    const std::set<int> free(options.free.begin(), options.free.end());
    std::erase_if(result.set.active, [&](int candidate) { return !free.contains(candidate); });
  }
  TRUEPOSE_RETURN_IF_ERROR(
      SolveWithWeights(result.set.active, direct, hooks, &frames_alone, &result));
  Finish(frames_alone, direct, &result);
  return result;
}

absl::StatusOr<IdentifiableSet> IdentifiableAtStart(const Problem& problem,
                                                    const IdentifiableSet& generic,
                                                    const Identification& before,
                                                    const IdentifyOptions& options) {
  // The weights of "before" are those of an uncalibrated robot: no bounds on deviations yet.
  IdentifiableSet set = SetAtNominal(problem, before, before.model_error, options, false);
  if (options.free.empty()) TRUEPOSE_RETURN_IF_ERROR(CheckFrames(problem, generic, set));
  MarkStructural(problem, generic, &set);
  return set;
}

absl::StatusOr<Identification> Identify(const Problem& problem, const IdentifiableSet& generic,
                                        const Identification& before,
                                        const IdentifyOptions& options, const Hooks& hooks) {
  Problem weighed = problem;
  Identification result;
  result.estimate = before.estimate;
  result.model_error = before.model_error;
  TRUEPOSE_ASSIGN_OR_RETURN(result.set, IdentifiableAtStart(problem, generic, before, options));
  TRUEPOSE_RETURN_IF_ERROR(SolveKept(before, options, hooks, &weighed, &result));
  MarkStructural(problem, generic, &result.set);
  Finish(weighed, options, &result);
  return result;
}

}  // namespace truepose
