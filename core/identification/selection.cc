#include "core/identification/selection.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/status_macros.h"
#include "core/identification/folds.h"
#include "core/identification/identifiability.h"
#include "core/identification/prediction.h"

namespace truepose {
namespace {

// Of fits that are only compared: they end where a further step moves the cost by less than any
// criterion sees.
constexpr int kTrialIterations = 30;
constexpr double kTrialTolerance = 1e-9;

double PositionRms(const Problem& problem, const Estimate& estimate) {
  double sum = 0;
  for (const Reading& reading : problem.readings) {
    const Residual r = ResidualAt(problem, reading, estimate);
    sum += r.head(PositionRowsOf(reading)).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(problem.readings.size()));
}

std::vector<int> Union(std::vector<int> a, const std::vector<int>& b) {
  a.insert(a.end(), b.begin(), b.end());
  std::sort(a.begin(), a.end());
  a.erase(std::unique(a.begin(), a.end()), a.end());
  return a;
}

// A parameter set together with its fit.
struct Fitted {
  int candidate = -1;  // what was added last
  std::vector<int> active;
  Estimate estimate;
  double cost = 0;
  double criterion = 0;
  Eigen::VectorXd held_out;  // kCrossValidation: sum of squares of each unit
};

class Selector {
 public:
  Selector(const Problem& problem, const ModelError& model_error,
           const std::vector<SelectionCandidate>& candidates, const SelectionOptions& options,
           const Hooks& hooks)
      : problem_(problem),
        model_error_(model_error),
        candidates_(candidates),
        options_(options),
        hooks_(hooks),
        reading_rows_(RowsOf(problem)),
        rows_(reading_rows_ + PriorRowsOf(problem)),
        left_(candidates.size(), true) {
    // The fits' own reports would step back in the run's progress.
    fit_hooks_.is_cancelled = hooks.is_cancelled;
    thorough_ = options.solve;
    thorough_.estimator = Estimator::kLevenbergMarquardt;
    quick_ = thorough_;
    quick_.max_iterations = std::min(quick_.max_iterations, kTrialIterations);
    quick_.function_tolerance = std::max(quick_.function_tolerance, kTrialTolerance);
  }

  absl::StatusOr<SelectionResult> Select(const Estimate& start, const std::vector<int>& base) {
    TRUEPOSE_RETURN_IF_ERROR(Prepare(start, base));
    Fitted current = Fit(base, thorough_), chosen = current;
    Record(current);
    size_t steps_taken = 1;
    for (;;) {
      std::optional<Fitted> best = BestOf(current);
      if (hooks_.Cancelled()) return absl::CancelledError("cancelled");
      if (!best) break;
      const bool worth_it = IsWorthIt(current, *best), goes_on = worth_it || GoesOn(current, *best);
      if (goes_on) *best = Refit(*best);
      Record(*best);
      if (!goes_on) break;
      left_[best->candidate] = false;
      current = *std::move(best);
      if (!worth_it) continue;
      chosen = current;
      steps_taken = result_.path.size();
    }
    Finish(chosen, steps_taken);
    return result_;
  }

 private:
  // Fits the base set; weights and dependence are those of its estimate and its nominal one.
  absl::Status Prepare(const Estimate& start, const std::vector<int>& base) {
    base_fit_ = start;
    Solve(problem_, model_error_, base, thorough_, fit_hooks_, &base_fit_);
    whiteners_ = WhitenersOf(problem_, base_fit_, model_error_);
    Estimate nominal = base_fit_;
    nominal.lambda.setZero();
    J_ = Whitened(problem_, nominal, model_error_).J;
    if (options_.criterion != SelectionCriterion::kCrossValidation) return absl::OkStatus();
    TRUEPOSE_ASSIGN_OR_RETURN(folds_, DealFolds(static_cast<int>(problem_.readings.size()),
                                                options_.units, options_.folds, options_.seed));
    return CheckFolds(problem_, model_error_, nominal, base, folds_);
  }

  Fitted Fit(const std::vector<int>& active, const SolveOptions& options) {
    Fitted fitted;
    fitted.active = active;
    fitted.estimate = base_fit_;
    Solve(problem_, model_error_, active, options, fit_hooks_, &fitted.estimate);
    fitted.cost = CostOf(problem_, fitted.estimate, whiteners_);
    Judge(&fitted);
    return fitted;
  }

  // The fit of the trial to the last bit.
  Fitted Refit(const Fitted& trial) {
    Fitted fitted = Fit(trial.active, thorough_);
    fitted.candidate = trial.candidate;
    return fitted;
  }

  void Judge(Fitted* fitted) {
    const double n = rows_, k = static_cast<double>(fitted->active.size());
    switch (options_.criterion) {
      case SelectionCriterion::kForward:
        fitted->criterion = options_.position_only ? PositionRms(problem_, fitted->estimate)
                                                   : std::sqrt(2 * fitted->cost / n);
        break;
      case SelectionCriterion::kBic:
        fitted->criterion = n * std::log(2 * fitted->cost / n) + k * std::log(n);
        break;
      case SelectionCriterion::kCrossValidation:
        fitted->held_out = HeldOut(fitted->active);
        fitted->criterion = std::sqrt(fitted->held_out.sum() / reading_rows_);
        break;
    }
  }

  Eigen::VectorXd HeldOut(const std::vector<int>& active) {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(folds_.unit_count);
    for (int fold = 0; fold < folds_.count && !hooks_.Cancelled(); ++fold) {
      Estimate estimate = base_fit_;
      Solve(Without(problem_, folds_, fold), model_error_, active, quick_, fit_hooks_, &estimate);
      AddHeldOut(problem_, whiteners_, estimate, folds_, fold, &sums);
    }
    return sums;
  }

  bool IsWorthIt(const Fitted& current, const Fitted& next) const {
    if (options_.criterion == SelectionCriterion::kForward)
      return next.criterion <= (1 - options_.least_improvement) * current.criterion;
    if (options_.criterion == SelectionCriterion::kBic) return next.criterion < current.criterion;
    const Eigen::ArrayXd falls = (current.held_out - next.held_out).array();
    const double n = static_cast<double>(falls.size());
    const double sd = std::sqrt((falls - falls.mean()).square().sum() * n / (n - 1));
    return falls.sum() > options_.least_fall_sd * sd;
  }

  // Whether the path is worth following though the step by itself is not: where a few readings
  // carry most of the sum of squares a real fall is uncertain until the rest has been explained.
  bool GoesOn(const Fitted& current, const Fitted& next) const {
    return options_.criterion == SelectionCriterion::kCrossValidation &&
           next.criterion < current.criterion;
  }

  std::optional<Fitted> BestOf(const Fitted& current) {
    std::optional<Fitted> best;
    for (size_t i = 0; i < candidates_.size() && !hooks_.Cancelled(); ++i) {
      if (!left_[i]) continue;
      const std::vector<int> added = Independent(current.active, candidates_[i].parameters);
      if (added.empty()) continue;
      Fitted fitted = Fit(Union(current.active, added), quick_);
      fitted.candidate = static_cast<int>(i);
      Report(i, fitted.cost);
      if (!best || fitted.criterion < best->criterion) best = std::move(fitted);
    }
    return best;
  }

  // Those of `parameters` that neither `active` nor the ones before them explain.
  std::vector<int> Independent(const std::vector<int>& active,
                               const std::vector<int>& parameters) const {
    std::vector<int> columns = active;
    for (int candidate : parameters) {
      if (!std::binary_search(active.begin(), active.end(), candidate))
        columns.push_back(candidate);
    }
    // Names do not matter here, but their order: all of one role are taken as they come.
    ParameterSet names;
    for (int candidate : columns)
      names.Add({std::to_string(candidate), ParameterGroup::kInternal, ParameterRole::kExternal});
    IdentifiabilityOptions options;
    options.use_sd_bounds = false;
    std::vector<int> added;
    for (int kept : Identifiable(J_(Eigen::all, columns), names, options).active) {
      if (kept >= static_cast<int>(active.size())) added.push_back(columns[kept]);
    }
    return added;
  }

  void Record(const Fitted& fitted) {
    result_.path.push_back({fitted.candidate < 0 ? "" : candidates_[fitted.candidate].label,
                            static_cast<int>(fitted.active.size()),
                            std::sqrt(2 * fitted.cost / rows_), fitted.criterion, false});
  }

  void Finish(const Fitted& chosen, size_t steps_taken) {
    for (size_t i = 0; i < steps_taken; ++i) {
      result_.path[i].taken = true;
      if (i > 0) result_.added.push_back(result_.path[i].added);
    }
    result_.active = chosen.active;
    result_.estimate = chosen.estimate;
  }

  void Report(size_t candidate, double cost) {
    const double rounds = static_cast<double>(candidates_.size());
    const double done =
        static_cast<double>(result_.path.size() - 1) + static_cast<double>(candidate + 1) / rounds;
    hooks_.Report({"selection", std::min(done / rounds, 1.0), ++trials_, cost});
  }

  const Problem& problem_;
  const ModelError model_error_;
  const std::vector<SelectionCandidate>& candidates_;
  const SelectionOptions& options_;
  const Hooks& hooks_;
  Hooks fit_hooks_;
  SolveOptions thorough_, quick_;
  const int reading_rows_, rows_;
  std::vector<bool> left_;
  Estimate base_fit_;
  Whiteners whiteners_;
  Eigen::MatrixXd J_;  // of all candidates, at lambda = 0
  Folds folds_;
  int trials_ = 0;
  SelectionResult result_;
};

}  // namespace

const char* Name(SelectionCriterion criterion) {
  switch (criterion) {
    case SelectionCriterion::kForward:
      return "forward";
    case SelectionCriterion::kBic:
      return "bic";
    case SelectionCriterion::kCrossValidation:
      break;
  }
  return "cross_validation";
}

absl::StatusOr<SelectionResult> Select(const Problem& problem, const ModelError& model_error,
                                       const Estimate& start, const std::vector<int>& base,
                                       const std::vector<SelectionCandidate>& candidates,
                                       const SelectionOptions& options, const Hooks& hooks) {
  return Selector(problem, model_error, candidates, options, hooks).Select(start, Union(base, {}));
}

}  // namespace truepose
