#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/identification/prediction.h"
#include "core/identification/weights.h"

namespace truepose {
namespace {

constexpr double kPositionFloor_m = 1e-7;
constexpr double kRotationFloor_rad = 1e-8;

// Rows of one group: squared residuals and squared stated deviations.
struct GroupRows {
  std::vector<double> squared_residual, stated_variance;
  double redundancy = 0;
};

double WeightedSum(const GroupRows& rows, double variance) {
  double sum = 0;
  for (size_t i = 0; i < rows.squared_residual.size(); ++i) {
    sum += rows.squared_residual[i] / (rows.stated_variance[i] + variance);
  }
  return sum;
}

// The variance at which the weighted sum is the redundancy, by bisection of its logarithm (the sum
// falls with it).
double SolveVariance(const GroupRows& rows, double floor) {
  double low = floor * floor, high = low;
  for (double r2 : rows.squared_residual) high = std::max(high, r2);
  if (rows.redundancy <= 0 || WeightedSum(rows, low) <= rows.redundancy) return low;
  high *= rows.squared_residual.size() / rows.redundancy;
  for (int i = 0; i < 200 && high > low * (1 + 1e-14); ++i) {
    const double middle = std::sqrt(low * high);
    (WeightedSum(rows, middle) > rows.redundancy ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

// trace((J'J)^-1 J_g'J_g): the parameters' share of the group. Columns are scaled, so the condition
// is that of the directions and not of the units.
double ShareOfGroup(const WhitenedSystem& system, const std::vector<int>& active,
                    WhitenedSystem::Row group) {
  Eigen::MatrixXd J = system.J(Eigen::all, active);
  for (Eigen::Index i = 0; i < J.cols(); ++i) J.col(i) /= std::max(J.col(i).norm(), 1e-300);
  const Eigen::LLT<Eigen::MatrixXd> normal(J.transpose() * J);
  for (Eigen::Index i = 0; i < J.rows(); ++i) {
    if (system.kind[i] != group) J.row(i).setZero();
  }
  return normal.solve(J.transpose() * J).trace();
}

GroupRows CollectGroup(const WhitenedSystem& system, WhitenedSystem::Row group, double model_sd,
                       const std::vector<int>& active, double consistency) {
  GroupRows rows;
  double weights = 0;
  for (Eigen::Index i = 0; i < system.raw.size(); ++i) {
    if (system.kind[i] != group) continue;
    const double limited = system.weight(i) * system.raw(i);
    rows.squared_residual.push_back(limited * limited);
    rows.stated_variance.push_back(
        std::max(0.0, system.sd(i) * system.sd(i) - model_sd * model_sd));
    weights += system.weight(i);
  }
  rows.redundancy = (weights - ShareOfGroup(system, active, group)) * consistency;
  return rows;
}

ModelError ByRedundancy(const Problem& problem, const Estimate& estimate,
                        const std::vector<int>& active, const ModelError& current,
                        double consistency) {
  const WhitenedSystem system = Whitened(problem, estimate, current);
  const auto solve = [&](WhitenedSystem::Row group, double model_sd, double floor) {
    const GroupRows rows = CollectGroup(system, group, model_sd, active, consistency);
    return rows.squared_residual.empty() ? model_sd : std::sqrt(SolveVariance(rows, floor));
  };
  return {solve(WhitenedSystem::Row::kPosition, current.position_sd_m, kPositionFloor_m),
          solve(WhitenedSystem::Row::kRotation, current.rotation_sd_rad, kRotationFloor_rad)};
}

bool Correlated(const Problem& problem) {
  return std::any_of(problem.readings.begin(), problem.readings.end(), [](const Reading& reading) {
    return reading.covariance.has_value() || reading.joint_sd.size() > 0;
  });
}

// One reading of the likelihood equations.
struct Term {
  int positions;
  Residual r;
  ResidualMatrix stated;    // R without s_model, weight taken out
  ResidualMatrix leverage;  // W J C J' W': the parameters' share, of whitened rows
  double weight;
};

// Sums of the two sides for position and rotation.
struct Sides {
  double quadratic[2] = {0, 0}, trace[2] = {0, 0};
};

// The leverage is that of the current weights: as shares of whitened rows it hardly moves with
// them, and I - leverage stays positive at any trial, which a fixed C would not.
void AddTerm(const Term& term, const ModelError& error, double consistency, Sides* sides) {
  ResidualMatrix R = term.stated;
  const Eigen::Index n = R.rows(), p = term.positions;
  R.diagonal().head(p).array() += error.position_sd_m * error.position_sd_m;
  R.diagonal().tail(n - p).array() += error.rotation_sd_rad * error.rotation_sd_rad;
  const ResidualMatrix L = R.llt().matrixL();
  const ResidualMatrix W =
      L.triangularView<Eigen::Lower>().solve(ResidualMatrix(ResidualMatrix::Identity(n, n)));
  const Residual z = W.transpose() * (W * term.r);
  const ResidualMatrix P = W.transpose() * (ResidualMatrix::Identity(n, n) - term.leverage) * W;
  sides->quadratic[0] += term.weight * term.weight * z.head(p).squaredNorm();
  sides->quadratic[1] += term.weight * term.weight * z.tail(n - p).squaredNorm();
  sides->trace[0] += consistency * term.weight * P.diagonal().head(p).sum();
  sides->trace[1] += consistency * term.weight * P.diagonal().tail(n - p).sum();
}

std::vector<Term> Terms(const Problem& problem, const Estimate& estimate,
                        const std::vector<int>& active, const ModelError& current) {
  const Whiteners whiteners = WhitenersOf(problem, estimate, current);
  const WhitenedSystem system = Whitened(problem, estimate, current, whiteners);
  const Eigen::MatrixXd J = system.J(Eigen::all, active);
  const Eigen::MatrixXd C =
      (J.transpose() * J).ldlt().solve(Eigen::MatrixXd::Identity(J.cols(), J.cols()));
  std::vector<Term> terms;
  Eigen::Index row = 0;
  for (size_t i = 0; i < problem.readings.size(); ++i) {
    Reading reading = problem.readings[i];
    const Eigen::Index n = RowsOf(reading);
    if (reading.weight > 0) {
      const double weight = std::exchange(reading.weight, 1.0);
      const Eigen::MatrixXd J_h = J.middleRows(row, n);
      terms.push_back({PositionRowsOf(reading), system.raw.segment(row, n),
                       CovarianceOf(problem, reading, estimate, {0, 0}), J_h * C * J_h.transpose(),
                       weight});
    }
    row += n;
  }
  return terms;
}

// The two components, one of which is varied while the other stands.
class Likelihood {
 public:
  Likelihood(std::vector<Term> terms, double consistency)
      : terms_(std::move(terms)), consistency_(consistency) {}

  // log(quadratic / trace) of a group when its deviation is `sd`: falls with sd, 0 at the estimate.
  double Imbalance(int group, double sd, ModelError error) const {
    (group == 0 ? error.position_sd_m : error.rotation_sd_rad) = sd;
    Sides sides;
    for (const Term& term : terms_) AddTerm(term, error, consistency_, &sides);
    if (!(sides.trace[group] > 0)) return 0;
    return std::log(std::max(sides.quadratic[group], 1e-300) / sides.trace[group]);
  }

  // The deviation of a group, the other held: bisection of its logarithm between the floor and
  // where the imbalance has turned.
  double Solve(int group, const ModelError& error, double floor) const {
    if (Imbalance(group, floor, error) <= 0) return floor;
    double low = floor,
           high = std::max(group == 0 ? error.position_sd_m : error.rotation_sd_rad, 10 * floor);
    for (int i = 0; i < 60 && Imbalance(group, high, error) > 0; ++i) {
      low = high;
      high *= 4;
    }
    while (high > low * (1 + 1e-9)) {
      const double middle = std::sqrt(low * high);
      (Imbalance(group, middle, error) > 0 ? low : high) = middle;
    }
    return std::sqrt(low * high);
  }

 private:
  std::vector<Term> terms_;
  double consistency_;
};

// One component after the other, until neither moves: they hardly depend on each other.
ModelError ByLikelihood(const Problem& problem, const Estimate& estimate,
                        const std::vector<int>& active, ModelError error, double consistency) {
  const Likelihood likelihood(Terms(problem, estimate, active, error), consistency);
  bool has_rotation = false;
  for (const Reading& reading : problem.readings)
    has_rotation = has_rotation || RotationRowsOf(reading) > 0;
  for (int i = 0; i < 10; ++i) {
    const ModelError last = error;
    error.position_sd_m = likelihood.Solve(0, error, kPositionFloor_m);
    if (has_rotation) error.rotation_sd_rad = likelihood.Solve(1, error, kRotationFloor_rad);
    if (std::abs(std::log(last.position_sd_m / error.position_sd_m)) +
            std::abs(std::log(last.rotation_sd_rad / error.rotation_sd_rad)) <
        1e-7)
      break;
  }
  return error;
}

}  // namespace

ModelError EstimateModelError(const Problem& problem, const Estimate& estimate,
                              const std::vector<int>& active, const ModelError& current,
                              double consistency) {
  return Correlated(problem) ? ByLikelihood(problem, estimate, active, current, consistency)
                             : ByRedundancy(problem, estimate, active, current, consistency);
}

}  // namespace truepose
