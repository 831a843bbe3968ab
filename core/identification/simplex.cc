#include "core/identification/simplex.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/identification/nelder_mead.h"
#include "core/identification/weighted_problem.h"

namespace truepose {
namespace {

// A restart that improves by less than this share ends the search.
constexpr double kNoImprovement = 1e-5;
// A run ends when its vertices differ by less than this share; ten times coarser, and a run ends
// 1 % above the minimum.
constexpr double kRunTolerance = 1e-4;
// A run starts with edges as long as the minimum is away: at the start of the search the root of
// the sum of squares over n, at a restart this share of what the last run has gained. Less than
// half a standard deviation is not worth a search.
constexpr double kShareOfGain = 0.5, kLeastEdge_sd = 0.5;
// Directions below this share of the largest are not seen by the mean position error.
constexpr double kNotSeen = 1e-6;

// What differs between the objectives.
class Objective {
 public:
  Objective(const WeightedProblem& problem, SimplexObjective objective)
      : problem_(problem), least_squares_(objective == SimplexObjective::kLeastSquares) {}

  double Value(const Eigen::VectorXd& x) const {
    return least_squares_ ? problem_.Cost(x) : problem_.MeanPositionError(x);
  }

  // The sum of squared residuals that belongs to a value, and the deviation of one residual.
  double SumOfSquares(double value) const {
    const auto readings = static_cast<double>(problem_.problem().readings.size());
    return least_squares_ ? 2 * value : readings * value * value;
  }
  double DeviationOf(double value) const { return least_squares_ ? 1 : value / std::sqrt(3.0); }

  // x = x0 + map y; empty where the readings do not determine every direction.
  Eigen::MatrixXd Map(const Eigen::VectorXd& x0) const {
    const Eigen::MatrixXd J = Jacobian(x0);
    const Eigen::VectorXd scale = ColumnScale(J);
    Eigen::BDCSVD<Eigen::MatrixXd> svd(J * scale.asDiagonal(), Eigen::ComputeThinV);
    if (!least_squares_) svd.setThreshold(kNotSeen);
    const Eigen::Index rank = svd.rank();
    if (least_squares_ && rank < J.cols()) return {};
    return scale.asDiagonal() * svd.matrixV().leftCols(rank) *
           svd.singularValues().head(rank).cwiseInverse().asDiagonal().toDenseMatrix();
  }

 private:
  Eigen::MatrixXd Jacobian(const Eigen::VectorXd& x) const {
    if (!least_squares_) return problem_.PositionJacobian(x);
    Eigen::VectorXd r;
    Eigen::MatrixXd J;
    problem_.Linearise(x, &r, &J);
    return J;
  }

  const WeightedProblem& problem_;
  const bool least_squares_;
};

class Search {
 public:
  Search(const WeightedProblem& problem, const SolveOptions& options, const Hooks& hooks)
      : problem_(problem),
        objective_(problem, options.simplex.objective),
        max_evaluations_(options.simplex.max_evaluations),
        hooks_(hooks),
        x_(problem.Start()),
        value_(objective_.Value(x_)),
        edge_(EdgeFor(objective_.SumOfSquares(value_))) {
    summary_.initial_cost = problem.Cost(x_);
    summary_.evaluations = 1;
  }

  SolveSummary Run() {
    if (!std::isfinite(summary_.initial_cost))
      return End(Termination::kFailed, "a residual at the start is not finite");
    for (;;) {
      const Eigen::MatrixXd map = objective_.Map(x_);
      if (map.size() == 0)
        return End(Termination::kFailed, "the readings do not determine the parameters");
      if (max_evaluations_ - summary_.evaluations <= map.cols()) return LimitReached();
      const double before = value_;
      const bool converged = RunOnce(map);
      if (hooks_.Cancelled()) return End(Termination::kCancelled, "");
      if (!converged) return LimitReached();
      if (before - value_ <= kNoImprovement * before) return End(Termination::kConverged, "");
    }
  }

  const Eigen::VectorXd& x() const { return x_; }

 private:
  SolveSummary LimitReached() {
    return End(Termination::kIterationLimit, "the limit of evaluations is reached");
  }

  SolveSummary End(Termination termination, std::string message) {
    summary_.termination = termination;
    summary_.message = std::move(message);
    summary_.final_cost = problem_.Cost(x_);
    return summary_;
  }

  double EdgeFor(double sum_of_squares) const {
    return std::sqrt(std::max(sum_of_squares, 0.0) / static_cast<double>(x_.size()));
  }

  // From x_ to the best vertex; false when stopped before it settled.
  bool RunOnce(const Eigen::MatrixXd& map) {
    const Eigen::VectorXd origin = x_;
    const auto value = [&](const Eigen::VectorXd& y) { return objective_.Value(origin + map * y); };
    const NelderMeadOptions options = {edge_, kRunTolerance * value_,
                                       max_evaluations_ - summary_.evaluations};
    const NelderMeadResult result =
        NelderMead(value, Eigen::VectorXd::Zero(map.cols()), options, [&] { return Stop(); });
    summary_.evaluations += result.evaluations;
    x_ = origin + map * result.point;
    const double gain = objective_.SumOfSquares(value_) - objective_.SumOfSquares(result.value);
    value_ = result.value;
    edge_ = std::max(kLeastEdge_sd * objective_.DeviationOf(value_), kShareOfGain * EdgeFor(gain));
    return result.converged;
  }

  bool Stop() {
    hooks_.Report({"identification", 0, ++summary_.iterations, value_});
    return hooks_.Cancelled();
  }

  const WeightedProblem& problem_;
  const Objective objective_;
  const int max_evaluations_;
  const Hooks& hooks_;
  Eigen::VectorXd x_;
  double value_, edge_;  // at x_; of the next simplex
  SolveSummary summary_;
};

}  // namespace

SolveSummary SearchBySimplex(const Problem& problem, const ModelError& model_error,
                             const std::vector<int>& active, const SolveOptions& options,
                             const Hooks& hooks, Estimate* estimate) {
  const Estimate start = *estimate;
  const WeightedProblem weighted(problem, model_error, active, start);
  Search search(weighted, options, hooks);
  const SolveSummary summary = search.Run();
  const bool usable = summary.termination == Termination::kConverged ||
                      summary.termination == Termination::kIterationLimit;
  if (usable) *estimate = weighted.At(search.x());
  return summary;
}

}  // namespace truepose
