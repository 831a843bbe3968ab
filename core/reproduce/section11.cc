#include "core/reproduce/section11.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/base/fault.h"
#include "core/base/random.h"
#include "core/base/status_macros.h"
#include "core/identification/identify.h"
#include "core/reproduce/readings_of_dime.h"

namespace truepose {
namespace {

// The weights are those that the noise of hand and encoders gives; a model error estimated from the
// residuals would differ from set to set, and with it the cost.
constexpr ModelError kNoModelError = {0, 0};

constexpr int kCalibrationPoses[] = {40, 60, 81};

Statistics ErrorsOf(const Problem& problem, const Estimate& estimate) {
  return PoseStatisticsOf(PoseErrors(problem, estimate)).position_m;
}

// One robot with both operators' readings.
struct Session {
  Model model = MeasuringRobot();
  Eigen::VectorXd truth;
  std::vector<Reading> first, second;
};

absl::StatusOr<Session> Draw(uint64_t seed) {
  Random random(seed);
  Session session;
  TRUEPOSE_ASSIGN_OR_RETURN(session.truth, DrawTruth(session.model, DimeTruth{}, &random));
  TRUEPOSE_ASSIGN_OR_RETURN(session.first,
                            ReadDime(session.model, session.truth, DimeNoise{}, &random));
  TRUEPOSE_ASSIGN_OR_RETURN(session.second,
                            ReadDime(session.model, session.truth, DimeNoise{}, &random));
  return session;
}

// The problems of one split; they point to the session's model.
struct Sets {
  Problem calibration, control, complete;
};

Sets SetsOf(const Session& session, const std::vector<int>& order, int calibration_poses) {
  std::vector<Reading> calibration, control;
  for (size_t i = 0; i < order.size(); ++i) {
    const bool calibrates = static_cast<int>(i) < calibration_poses;
    (calibrates ? calibration : control).push_back(session.first[order[i]]);
  }
  if (control.empty()) control = session.second;
  return {MeasuringRobotProblem(session.model, std::move(calibration)),
          MeasuringRobotProblem(session.model, std::move(control)),
          MeasuringRobotProblem(session.model, session.first)};
}

Estimate EstimateOf(const Problem& problem, const Eigen::VectorXd& lambda) {
  Estimate estimate = NominalEstimate(problem);
  estimate.lambda = lambda;
  return estimate;
}

absl::StatusOr<DimeSplit> SplitOf(const Session& session, const Sets& sets, const Hooks& hooks) {
  const Estimate nominal = NominalEstimate(sets.calibration);
  const Estimate truth = EstimateOf(sets.calibration, session.truth);
  TRUEPOSE_ASSIGN_OR_RETURN(const Identification frames,
                            FitFrames(sets.calibration, nominal, IdentifyOptions{}, hooks));
  return DimeSplit{static_cast<int>(sets.calibration.readings.size()),
                   static_cast<int>(sets.control.readings.size()),
                   ErrorsOf(sets.calibration, nominal),
                   ErrorsOf(sets.control, nominal),
                   ErrorsOf(sets.calibration, frames.estimate),
                   ErrorsOf(sets.control, frames.estimate),
                   ErrorsOf(sets.calibration, truth),
                   ErrorsOf(sets.control, truth)};
}

// What one set of parameters is: its candidates, and the names of what was added to the 14.
struct ParameterChoice {
  DimeSet set;
  std::vector<int> active;
  std::vector<std::string> added;
};

class Experiment {
 public:
  Experiment(const Section11Options& options, const Hooks& hooks)
      : options_(options), hooks_(hooks) {
    fit_hooks_.is_cancelled = hooks.is_cancelled;
  }

  absl::StatusOr<Section11Result> Run() {
    Section11Result result;
    for (uint64_t seed : options_.seeds) {
      TRUEPOSE_ASSIGN_OR_RETURN(Section11Seed of_seed, RunSeed(seed));
      result.seeds.push_back(std::move(of_seed));
    }
    return result;
  }

 private:
  absl::StatusOr<Section11Seed> RunSeed(uint64_t seed) {
    TRUEPOSE_ASSIGN_OR_RETURN(const Session session, Draw(seed));
    Section11Seed result;
    result.seed = seed;
    const Problem complete = MeasuringRobotProblem(session.model, session.first);
    result.nominal = ErrorsOf(complete, NominalEstimate(complete));
    CompareOperators(session, &result);
    const std::vector<int> order = Shuffled(static_cast<int>(session.first.size()), seed);
    for (int poses : kCalibrationPoses)
      TRUEPOSE_RETURN_IF_ERROR(RunSplit(session, SetsOf(session, order, poses), &result));
    return result;
  }

  static void CompareOperators(const Session& session, Section11Seed* result) {
    const Eigen::VectorXd nominal = Eigen::VectorXd::Zero(session.truth.size());
    std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> pairs;
    std::vector<Eigen::Matrix3Xd> groups;
    for (size_t i = 0; i < session.first.size(); ++i) {
      pairs.emplace_back(Forward(session.model, session.first[i].q, nominal).p,
                         Forward(session.model, session.second[i].q, nominal).p);
      groups.emplace_back(3, 2) << pairs.back().first, pairs.back().second;
    }
    result->operators = RepeatabilityOfPairs(pairs);
    result->operators_iso = RepeatabilityOfGroups(groups);
  }

  absl::Status RunSplit(const Session& session, const Sets& sets, Section11Seed* result) {
    TRUEPOSE_ASSIGN_OR_RETURN(DimeSplit split, SplitOf(session, sets, fit_hooks_));
    result->splits.push_back(std::move(split));
    TRUEPOSE_ASSIGN_OR_RETURN(SelectionRun selection, RunSelection(sets.calibration));
    for (const ParameterChoice& choice : Choices(sets.calibration, selection.result)) {
      for (const DimeEstimator& estimator : DimeEstimators()) {
        result->fits.push_back(Fit(sets, choice, estimator));
        if (hooks_.Cancelled()) return absl::CancelledError("cancelled");
        Report();
      }
    }
    result->selections.push_back(std::move(selection));
    return absl::OkStatus();
  }

  absl::StatusOr<SelectionRun> RunSelection(const Problem& calibration) const {
    std::vector<SelectionCandidate> candidates;
    for (const std::string& name : AdditionalSet())
      candidates.push_back({name, CandidatesNamed(calibration, {name})});
    SelectionRun run;
    run.calibration_poses = static_cast<int>(calibration.readings.size());
    const double start = Now();
    TRUEPOSE_ASSIGN_OR_RETURN(run.result,
                              Select(calibration, kNoModelError, NominalEstimate(calibration),
                                     CandidatesNamed(calibration, ReducedSet()), candidates,
                                     options_.selection, fit_hooks_));
    run.time_s = Now() - start;
    return run;
  }

  static std::vector<ParameterChoice> Choices(const Problem& problem,
                                              const SelectionResult& selection) {
    std::vector<int> all(problem.model->parameters.size());
    std::iota(all.begin(), all.end(), problem.FirstInternal());
    return {{DimeSet::kComplete, all, {}},
            {DimeSet::kReduced, CandidatesNamed(problem, ReducedSet()), {}},
            {DimeSet::kSelected, selection.active, selection.added}};
  }

  DimeFit Fit(const Sets& sets, const ParameterChoice& choice,
              const DimeEstimator& estimator) const {
    Estimate estimate = NominalEstimate(sets.calibration);
    const Whiteners whiteners = WhitenersOf(sets.calibration, estimate, kNoModelError);
    DimeFit fit;
    const double start = Now();
    fit.termination = Solve(sets.calibration, kNoModelError, choice.active, estimator.options,
                            fit_hooks_, &estimate)
                          .termination;
    fit.time_s = Now() - start;
    fit.set = choice.set;
    fit.added = choice.added;
    fit.estimator = estimator.name;
    fit.calibration_poses = static_cast<int>(sets.calibration.readings.size());
    fit.control_poses = static_cast<int>(sets.control.readings.size());
    fit.calibration = ErrorsOf(sets.calibration, estimate);
    fit.control = ErrorsOf(sets.control, estimate);
    fit.complete = ErrorsOf(sets.complete, estimate);
    fit.cost = CostOf(sets.calibration, estimate, whiteners);
    return fit;
  }

  double Now() const { return options_.clock ? options_.clock() : 0; }

  void Report() {
    const size_t fits =
        options_.seeds.size() * std::size(kCalibrationPoses) * 3 * DimeEstimators().size();
    ++fits_done_;
    hooks_.Report(
        {"section11", static_cast<double>(fits_done_) / static_cast<double>(fits), fits_done_, 0});
  }

  const Section11Options& options_;
  const Hooks& hooks_;
  Hooks fit_hooks_;
  int fits_done_ = 0;
};

SolveOptions By(Estimator estimator) {
  SolveOptions options;
  options.estimator = estimator;
  return options;
}

SolveOptions Kalman(int passes) {
  SolveOptions options = By(Estimator::kKalman);
  options.kalman.passes = passes;
  return options;
}

}  // namespace

const char* Name(DimeSet set) {
  switch (set) {
    case DimeSet::kComplete:
      return "25";
    case DimeSet::kReduced:
      return "14";
    case DimeSet::kSelected:
      break;
  }
  return "14 + selected";
}

const std::vector<DimeEstimator>& DimeEstimators() {
  static const auto* const kEstimators =
      new std::vector<DimeEstimator>{{"levenberg_marquardt", By(Estimator::kLevenbergMarquardt)},
                                     {"linear_iteration", By(Estimator::kLinearIteration)},
                                     {"kalman, one pass", Kalman(1)},
                                     {"kalman, two passes", Kalman(2)},
                                     {"simplex", By(Estimator::kSimplex)}};
  return *kEstimators;
}

absl::StatusOr<Section11Result> Section11(const Section11Options& options, const Hooks& hooks) {
  if (options.seeds.empty()) return FaultStatus("seeds", "none", "at least one");
  return Experiment(options, hooks).Run();
}

}  // namespace truepose
