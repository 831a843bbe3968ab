#include "core/calibrate/effect_choice.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/calibrate/sets.h"
#include "core/identification/folds.h"
#include "core/identification/prior.h"

namespace truepose {
namespace {

// What is known of the parameters before the readings, effects among them: the prior of the
// problem that is solved.
Prior WidenedPrior(const Problem& problem, const Model& wide) {
  Prior prior = problem.prior.value_or(NoPrior(problem.model->parameters));
  const Eigen::Index size = wide.parameters.size();
  prior.mean.conservativeResizeLike(Eigen::VectorXd::Zero(size));
  prior.root.conservativeResizeLike(Eigen::MatrixXd::Zero(prior.root.rows(), size));
  AddEffectPrior(wide.parameters, &prior);
  return prior;
}

// The linearised problem of all candidates, effects included, with a fold for each row.
class Linearised {
 public:
  Linearised(const Problem& problem, const Estimate& estimate, const ModelError& error,
             const EffectChoiceOptions& options)
      : system_(Whitened(problem, estimate, error)), names_(Candidates(problem)) {
    const Units units = UnitsOf(problem);
    units_ = units.count;
    folds_ = std::max(1, std::min(options.folds, units_));
    const Folds folds = DealFolds(units, folds_, options.seed);
    for (size_t i = 0; i < problem.readings.size(); ++i) {
      for (int row = 0; row < RowsOf(problem.readings[i]); ++row) {
        unit_.push_back(units.of[i]);
        fold_.push_back(folds.fold_of[units.of[i]]);
      }
    }
  }

  // Measured values; those of a prior are not among them. Of a reading six at most: a flange has no
  // more coordinates, however many points of it are seen.
  int values() const {
    std::vector<int> of_unit(units_, 0);
    for (const int unit : unit_) of_unit[unit] = std::min(of_unit[unit] + 1, 6);
    return std::accumulate(of_unit.begin(), of_unit.end(), 0);
  }
  int readings() const { return units_; }

  // Of `columns`, those that are independent by the readings alone, as when they are identified.
  std::vector<int> Independent(const std::vector<int>& columns) const {
    ParameterSet names;
    for (int column : columns) names.Add(names_[column]);
    IdentifiabilityOptions options;
    options.use_sd_bounds = false;
    const Eigen::MatrixXd J = system_.J.topRows(ReadingRows())(Eigen::all, columns);
    std::vector<int> kept;
    for (int index : Identifiable(J, names, options).active) kept.push_back(columns[index]);
    return kept;
  }

  // Squared held-out residual of each unit when `columns` are fitted on the other folds.
  std::vector<double> HeldOut(const std::vector<int>& columns) const {
    const Eigen::MatrixXd J = Scaled(columns);
    const Eigen::MatrixXd all = J.transpose() * J;
    const Eigen::VectorXd right = J.transpose() * system_.r;
    std::vector<double> squares(units_, 0);
    for (int fold = 0; fold < folds_; ++fold) {
      const std::vector<int> rows = RowsOfFold(fold);
      const Eigen::MatrixXd J_out = J(rows, Eigen::all);
      const Eigen::VectorXd r_out = system_.r(rows);
      const Eigen::VectorXd x =
          (all - J_out.transpose() * J_out).ldlt().solve(right - J_out.transpose() * r_out);
      const Eigen::VectorXd left = r_out - J_out * x;
      for (size_t i = 0; i < rows.size(); ++i) {
        const double residual = left(static_cast<Eigen::Index>(i));
        squares[unit_[rows[i]]] += residual * residual;
      }
    }
    return squares;
  }

  // Weighted RMS of a row when `columns` are fitted to all.
  double FittedRms(const std::vector<int>& columns) const {
    const Eigen::MatrixXd J = Scaled(columns);
    const Eigen::VectorXd left = system_.r - J * J.householderQr().solve(system_.r);
    return std::sqrt(left.head(ReadingRows()).squaredNorm() / static_cast<double>(ReadingRows()));
  }

  double Rms(const std::vector<double>& squares) const {
    return std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) /
                     static_cast<double>(unit_.size()));
  }

 private:
  // Those of the prior come after them.
  Eigen::Index ReadingRows() const { return static_cast<Eigen::Index>(unit_.size()); }

  // The columns, each of norm 1: their units don't matter here, nor does their sign.
  Eigen::MatrixXd Scaled(const std::vector<int>& columns) const {
    Eigen::MatrixXd J = system_.J(Eigen::all, columns);
    J.colwise().normalize();
    return J;
  }

  std::vector<int> RowsOfFold(int fold) const {
    std::vector<int> rows;
    for (size_t row = 0; row < fold_.size(); ++row)
      if (fold_[row] == fold) rows.push_back(static_cast<int>(row));
    return rows;
  }

  WhitenedSystem system_;
  ParameterSet names_;
  std::vector<int> unit_, fold_;  // of each row
  int units_ = 0, folds_ = 0;
};

// Mean and standard error of the drop from one list of squares to another.
struct Drop {
  double mean, standard_error;
};

Drop DropOf(const std::vector<double>& from, const std::vector<double>& to) {
  const double n = static_cast<double>(from.size());
  double sum = 0, squares = 0;
  for (size_t i = 0; i < from.size(); ++i) sum += from[i] - to[i];
  const double mean = sum / n;
  for (size_t i = 0; i < from.size(); ++i)
    squares += (from[i] - to[i] - mean) * (from[i] - to[i] - mean);
  return {mean, std::sqrt(squares / (n * std::max(n - 1, 1.0)))};
}

std::vector<int> ColumnsOfGroup(const Problem& problem, const Robot& robot, EffectGroup group,
                                const Model& geometric) {
  Model alone = geometric;
  AddEffects(robot, group, &alone);
  const ParameterSet all = Candidates(problem);
  std::vector<int> columns;
  for (int i = geometric.parameters.size(); i < alone.parameters.size(); ++i)
    columns.push_back(*all.Find(alone.parameters[i].name));
  return columns;
}

std::vector<int> Joined(std::vector<int> a, const std::vector<int>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

struct Candidate {
  EffectGroup group;
  std::vector<int> columns;
};

bool IsEnough(const Linearised& system, const EffectChoiceOptions& options, size_t parameters) {
  return system.values() >= options.values_per_parameter * static_cast<double>(parameters);
}

double LeastGain(const Linearised& system, const EffectChoiceOptions& options, size_t parameters) {
  const double many = 2 * options.values_per_parameter * static_cast<double>(parameters);
  return system.values() >= many ? options.least_gain : options.least_gain_of_few;
}

// A group that there are too few readings for now never comes in: what is taken only adds
// parameters. So it leaves the list, with its reason.
void DropWithoutReadings(const Linearised& system, const EffectChoiceOptions& options,
                         const std::vector<int>& columns, std::vector<Candidate>* left,
                         EffectChoice* choice) {
  std::erase_if(*left, [&](const Candidate& candidate) {
    const size_t parameters = system.Independent(Joined(columns, candidate.columns)).size();
    if (IsEnough(system, options, parameters)) return false;
    // What was looked at with fewer groups beside it stands in the path already.
    const bool looked_at =
        std::any_of(choice->path.begin(), choice->path.end(),
                    [&](const EffectStep& step) { return step.added == Name(candidate.group); });
    if (!looked_at)
      choice->untried.push_back(
          {candidate.group,
           absl::StrCat(system.readings(), " readings give ", system.values(), " values, ",
                        std::ceil(options.values_per_parameter * static_cast<double>(parameters)),
                        " needed for ", parameters, " parameters"),
           -1});
    return true;
  });
}

// Looks at every group left and takes the best one if it is entitled. @returns whether one was.
bool TakeOne(const Linearised& system, const EffectChoiceOptions& options,
             std::vector<int>* columns, std::vector<Candidate>* left, EffectChoice* choice) {
  const std::vector<double> now = system.HeldOut(*columns);
  size_t best = left->size();
  double best_mean = 0;
  std::vector<int> best_columns;
  for (size_t i = 0; i < left->size(); ++i) {
    const std::vector<int> wider = system.Independent(Joined(*columns, (*left)[i].columns));
    const std::vector<double> then = system.HeldOut(wider);
    choice->path.push_back({Name((*left)[i].group), static_cast<int>(wider.size()),
                            system.FittedRms(wider), system.Rms(then), false});
    const auto [mean, standard_error] = DropOf(now, then);
    const double gain = LeastGain(system, options, wider.size());
    const bool enough = system.Rms(then) <= (1 - gain) * system.Rms(now);
    if (!enough || mean <= standard_error || mean <= best_mean) continue;
    best = i, best_mean = mean, best_columns = wider;
  }
  if (best == left->size()) return false;
  const std::string name = Name((*left)[best].group);
  for (auto step = choice->path.rbegin(); step != choice->path.rend(); ++step) {
    if (step->added != name) continue;
    step->taken = true;
    break;
  }
  choice->groups.push_back((*left)[best].group);
  *columns = best_columns;
  left->erase(left->begin() + static_cast<std::ptrdiff_t>(best));
  return true;
}

}  // namespace

std::vector<UntriedEffect> EffectsWithoutCause(const Robot& robot, const Problem& problem) {
  std::vector<UntriedEffect> untried;
  int without_torque = 0, first_without = -1;
  bool temperature = false;
  for (const Reading& reading : problem.readings) {
    temperature = temperature ||
                  reading.conditions.temperature_K != problem.readings[0].conditions.temperature_K;
    if (reading.conditions.joint_torque.size() > 0) continue;
    if (++without_torque == 1) first_without = reading.id;
  }
  if (without_torque > 0 && robot.masses().empty())
    untried.push_back(
        {EffectGroup::kCompliance,
         absl::StrCat("joint torques (tau1_Nm...) are missing in ", without_torque, " of ",
                      problem.readings.size(), " readings, and the robot file has no masses"),
         first_without});
  if (!temperature)
    untried.push_back({EffectGroup::kTemperature, "there is no temperature (temp_C) that varies"});
  return untried;
}

std::vector<EffectGroup> AvailableEffects(const Robot& robot, const Problem& problem) {
  std::vector<EffectGroup> groups = AllEffectGroups();
  for (const UntriedEffect& untried : EffectsWithoutCause(robot, problem))
    std::erase(groups, untried.group);
  return groups;
}

EffectChoice ChooseEffects(const Robot& robot, const Problem& problem,
                           const Identification& geometric, const EffectChoiceOptions& options) {
  Model wide = *problem.model;
  for (EffectGroup group : AvailableEffects(robot, problem)) AddEffects(robot, group, &wide);
  Problem with_effects = problem;
  with_effects.model = &wide;
  with_effects.prior = WidenedPrior(problem, wide);
  Estimate estimate = geometric.estimate;
  estimate.lambda.conservativeResizeLike(Eigen::VectorXd::Zero(wide.parameters.size()));
  const Linearised system(with_effects, estimate, geometric.model_error, options);
  std::vector<Candidate> left;
  for (EffectGroup group : AvailableEffects(robot, problem))
    left.push_back({group, ColumnsOfGroup(with_effects, robot, group, *problem.model)});
  std::vector<int> columns = geometric.set.active;
  EffectChoice choice;
  choice.path.push_back({"", static_cast<int>(columns.size()), system.FittedRms(columns),
                         system.Rms(system.HeldOut(columns)), true});
  choice.untried = EffectsWithoutCause(robot, problem);
  do {
    DropWithoutReadings(system, options, columns, &left, &choice);
  } while (TakeOne(system, options, &columns, &left, &choice));
  return choice;
}

}  // namespace truepose
