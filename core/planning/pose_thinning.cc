#include "core/planning/pose_thinning.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/identification/identifiability.h"
#include "core/planning/d_optimal.h"

namespace truepose {
namespace {

// Whitened rows of each reading by the candidates that all readings together determine. At nominal
// lambda, where the model's own redundancies are exact (identify.cc).
std::vector<Eigen::MatrixXd> BlocksOf(const Problem& problem, const Estimate& estimate,
                                      const ModelError& model_error) {
  Problem readings = problem;
  readings.prior.reset();
  Estimate nominal = estimate;
  nominal.lambda.setZero();
  const Eigen::MatrixXd J = Whitened(readings, nominal, model_error).J;
  const IdentifiableSet set = Identifiable(J, Candidates(readings), {});
  std::vector<Eigen::MatrixXd> blocks;
  Eigen::Index row = 0;
  for (const Reading& reading : readings.readings) {
    blocks.push_back(J.middleRows(row, RowsOf(reading))(Eigen::all, set.active));
    row += RowsOf(reading);
  }
  return blocks;
}

// The fewest readings whose rows exceed the parameters.
int LeastCount(const std::vector<Eigen::MatrixXd>& blocks) {
  Eigen::Index most_rows = 1;
  for (const Eigen::MatrixXd& block : blocks) most_rows = std::max(most_rows, block.rows());
  return static_cast<int>(blocks.front().cols() / most_rows) + 1;
}

absl::Status CheckCount(const std::vector<Eigen::MatrixXd>& blocks, int count) {
  const int least = LeastCount(blocks), most = static_cast<int>(blocks.size());
  FaultList faults;
  if (count < least)
    faults.Add("poses", absl::StrCat(count),
               absl::StrCat("at least ", least, ", for ", blocks.front().cols(), " parameters"));
  if (count > most)
    faults.Add("poses", absl::StrCat(count), absl::StrCat("at most the ", most, " candidates"));
  return faults.ToStatus();
}

double ConditionOf(const std::vector<Eigen::MatrixXd>& blocks, const std::vector<int>& chosen) {
  const Eigen::Index p = blocks.front().cols();
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(p, p);
  for (int h : chosen) {
    const Eigen::MatrixXd& J = blocks[static_cast<size_t>(h)];
    M += J.transpose() * J;
  }
  const Eigen::VectorXd scale = M.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::VectorXd s =
      (scale.asDiagonal() * M * scale.asDiagonal()).selfadjointView<Eigen::Lower>().eigenvalues();
  return std::sqrt(s(p - 1) / s(0));
}

double TravelOf(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

}  // namespace

std::vector<int> MeasuringOrder(std::vector<int> indices, const std::vector<Eigen::VectorXd>& q) {
  std::sort(indices.begin(), indices.end());
  for (size_t i = 1; i < indices.size(); ++i) {
    const Eigen::VectorXd& here = q[static_cast<size_t>(indices[i - 1])];
    const auto next = std::min_element(
        indices.begin() + static_cast<std::ptrdiff_t>(i), indices.end(), [&](int a, int b) {
          const double to_a = TravelOf(q[static_cast<size_t>(a)], here),
                       to_b = TravelOf(q[static_cast<size_t>(b)], here);
          return to_a < to_b || (to_a == to_b && a < b);
        });
    std::iter_swap(indices.begin() + static_cast<std::ptrdiff_t>(i), next);
  }
  return indices;
}

absl::StatusOr<ThinnedPoses> ThinPoses(const Problem& problem, const Estimate& estimate,
                                       const ModelError& model_error, int count,
                                       const Hooks& hooks) {
  if (problem.readings.empty()) return FaultStatus("candidates", "none", "poses to choose from");
  const std::vector<Eigen::MatrixXd> blocks = BlocksOf(problem, estimate, model_error);
  TRUEPOSE_RETURN_IF_ERROR(CheckCount(blocks, count));
  const std::vector<int> chosen = ChooseDOptimal(blocks, count, hooks);
  if (hooks.Cancelled()) return absl::CancelledError("cancelled");
  ThinnedPoses thinned;
  thinned.parameters = static_cast<int>(blocks.front().cols());
  thinned.log_det = LogDetOf(blocks, chosen);
  if (!std::isfinite(thinned.log_det)) {
    FaultList faults;
    faults.Add("poses", absl::StrCat(count),
               absl::StrCat("more: no choice of so few determines all ", thinned.parameters,
                            " parameters"));
    return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
  }
  thinned.condition = ConditionOf(blocks, chosen);
  std::vector<Eigen::VectorXd> q;
  for (const Reading& reading : problem.readings) q.push_back(reading.q);
  thinned.indices = MeasuringOrder(chosen, q);
  return thinned;
}

}  // namespace truepose
