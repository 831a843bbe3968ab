#include "core/identification/weights.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/identification/prediction.h"

namespace truepose {
namespace {

constexpr double kPositionFloor_m = 1e-7;
constexpr double kRotationFloor_rad = 1e-8;

int RowCount(const Problem& problem) {
  int rows = 0;
  for (const Reading& reading : problem.readings) rows += RowsOf(reading);
  return rows;
}

void FillReading(const Problem& problem, const Reading& reading, int row, const Residual& r,
                 const Residual& sd, const ReadingJacobian& J, WhitenedSystem* system) {
  const Eigen::Index rows = r.size();
  const auto weight = sd.cwiseInverse().asDiagonal();
  system->r.segment(row, rows) = r;
  system->sd.segment(row, rows) = sd;
  for (Eigen::Index i = 0; i < rows; ++i) system->rotation[row + i] = i >= 3;
  system->J.block(row, problem.FirstOfBase(reading.placement), rows, kFrameParameters) =
      weight * J.base;
  system->J.block(row, problem.FirstOfTool(reading.target), rows, kFrameParameters) =
      weight * J.tool;
  system->J.block(row, problem.FirstInternal(), rows, J.internal.cols()) = weight * J.internal;
}

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

GroupRows CollectGroup(const WhitenedSystem& system, bool rotation, double model_sd) {
  GroupRows rows;
  for (Eigen::Index i = 0; i < system.r.size(); ++i) {
    if (system.rotation[i] != rotation) continue;
    rows.squared_residual.push_back(system.r(i) * system.r(i));
    rows.stated_variance.push_back(
        std::max(0.0, system.sd(i) * system.sd(i) - model_sd * model_sd));
  }
  return rows;
}

// trace((J'J)^-1 J_g'J_g): the parameters' share of the group. Columns are scaled, so the condition
// is that of the directions and not of the units.
double ShareOfGroup(const WhitenedSystem& system, const std::vector<int>& active, bool rotation) {
  Eigen::MatrixXd J = system.J(Eigen::all, active);
  for (Eigen::Index i = 0; i < J.cols(); ++i) J.col(i) /= std::max(J.col(i).norm(), 1e-300);
  const Eigen::LLT<Eigen::MatrixXd> normal(J.transpose() * J);
  for (Eigen::Index i = 0; i < J.rows(); ++i) {
    if (system.rotation[i] != rotation) J.row(i).setZero();
  }
  return normal.solve(J.transpose() * J).trace();
}

}  // namespace

Residual StandardDeviations(const Reading& reading, const ModelError& model_error) {
  Residual sd(RowsOf(reading));
  const double p2 = model_error.position_sd_m * model_error.position_sd_m;
  sd.head<3>() = (reading.position_sd_m.array().square() + p2).sqrt();
  sd.tail(sd.size() - 3).setConstant(model_error.rotation_sd_rad);
  return sd;
}

WhitenedSystem Whitened(const Problem& problem, const Estimate& estimate,
                        const ModelError& model_error) {
  const int rows = RowCount(problem);
  WhitenedSystem system{Eigen::VectorXd(rows), Eigen::VectorXd(rows), std::vector<bool>(rows),
                        Eigen::MatrixXd::Zero(rows, problem.CandidateCount())};
  const double zero[kFrameParameters] = {};
  Workspace workspace;
  Residual r;
  ReadingJacobian J;
  int row = 0;
  for (const Reading& reading : problem.readings) {
    EvaluateReading(*problem.model, reading, estimate.X_MB[reading.placement],
                    estimate.X_FT[reading.target], zero, zero, estimate.lambda.data(), &workspace,
                    &r, &J);
    FillReading(problem, reading, row, r, StandardDeviations(reading, model_error), J, &system);
    row += static_cast<int>(r.size());
  }
  return system;
}

ModelError EstimateModelError(const Problem& problem, const Estimate& estimate,
                              const std::vector<int>& active, const ModelError& current) {
  const WhitenedSystem system = Whitened(problem, estimate, current);
  GroupRows position = CollectGroup(system, false, current.position_sd_m);
  GroupRows rotation = CollectGroup(system, true, current.rotation_sd_rad);
  position.redundancy = position.squared_residual.size() - ShareOfGroup(system, active, false);
  rotation.redundancy = rotation.squared_residual.size() - ShareOfGroup(system, active, true);
  ModelError estimate_of_error = current;
  estimate_of_error.position_sd_m = std::sqrt(SolveVariance(position, kPositionFloor_m));
  if (!rotation.squared_residual.empty()) {
    estimate_of_error.rotation_sd_rad = std::sqrt(SolveVariance(rotation, kRotationFloor_rad));
  }
  return estimate_of_error;
}

}  // namespace truepose
