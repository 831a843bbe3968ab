#include "core/identification/kalman.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "absl/strings/str_format.h"

namespace truepose {
namespace {

constexpr double kReachedMinimum = 2e-3;  // of the cost
constexpr double kDivergedBy = 10;        // times the cost at the start

double InitialDeviation(const Parameter& parameter, const KalmanOptions& options) {
  const bool frame = parameter.role == ParameterRole::kExternal;
  switch (parameter.unit) {
    case Unit::kMetre:
      return frame ? options.frame_length_sd_m : options.length_sd_m;
    case Unit::kRadian:
      return frame ? options.frame_angle_sd_rad : options.angle_sd_rad;
    case Unit::kRatio:
      return options.ratio_sd;
    case Unit::kRadianPerNewtonMetre:
      return options.compliance_sd_rad_per_nm;
    case Unit::kMetrePerNewton:
      return options.compliance_sd_m_per_n;
    case Unit::kRadianPerKelvin:
      return options.drift_sd_rad_per_k;
    case Unit::kMetrePerKelvin:
      break;
  }
  return options.drift_sd_m_per_k;
}

// One pass over all readings from the start; false when cancelled.
bool Pass(const WeightedProblem& problem, const Hooks& hooks, KalmanFilter* filter) {
  const std::vector<Reading>& readings = problem.problem().readings;
  for (size_t i = 0; i < readings.size(); ++i) {
    if (hooks.Cancelled()) return false;
    filter->Update(readings[i], problem.whiteners()[i]);
  }
  return true;
}

// Fills in how the filter's end compares with the minimum.
void Judge(const WeightedProblem& problem, const Eigen::VectorXd& x, SolveSummary* summary) {
  if (!x.allFinite() || !(summary->final_cost <= kDivergedBy * summary->initial_cost)) {
    summary->termination = Termination::kFailed;
    summary->message = absl::StrFormat("diverged: the cost went from %g to %g",
                                       summary->initial_cost, summary->final_cost);
    return;
  }
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
  problem.Linearise(x, &r, &J);
  const double left = SolveLinear(r, J).decrease;
  const bool reached = left <= std::max(kReachedMinimum * summary->final_cost, 1e-14);
  summary->termination = reached ? Termination::kConverged : Termination::kIterationLimit;
  if (!reached) {
    summary->message = absl::StrFormat("%.2g %% of the cost is left after %d passes",
                                       100 * left / summary->final_cost, summary->iterations);
  }
}

}  // namespace

KalmanFilter::KalmanFilter(const Problem& problem, const std::vector<int>& active,
                           const Estimate& start, const Eigen::MatrixXd& P_0)
    : problem_(problem),
      active_(active),
      start_(start),
      start_values_(ValuesOf(problem, start)),
      x_(start_values_(active)) {
  const Eigen::Index n = x_.size();
  // P_0 = L L', so L^-1 is a root of the information; the QR makes it upper triangular.
  const Eigen::MatrixXd root = P_0.llt().matrixL().solve(Eigen::MatrixXd::Identity(n, n));
  Eigen::MatrixXd rows(n, n + 1);
  rows << root, root * x_;
  triangle_ = Eigen::MatrixXd::Zero(n, n + 1);
  Absorb(rows);
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
  LinearisePrior(problem, active_, start_values_, &r, &J);
  Eigen::MatrixXd prior(r.size(), n + 1);
  prior << J, J * x_ - r;
  Absorb(prior);
  SolveState();
}

Eigen::VectorXd KalmanFilter::Values(const Eigen::VectorXd& x) const {
  Eigen::VectorXd values = start_values_;
  values(active_) = x;
  return values;
}

void KalmanFilter::LineariseAt(const Eigen::VectorXd& x) { x_linear_ = x; }

void KalmanFilter::Update(const Reading& reading, const ResidualMatrix& whitener) {
  const Eigen::VectorXd& at = x_linear_ ? *x_linear_ : x_;
  Residual r;
  RowJacobian J;
  LineariseReading(problem_, reading, whitener, active_, start_, Values(at), &workspace_, &r, &J);
  Eigen::MatrixXd rows(r.size(), x_.size() + 1);
  rows << J, J * at - r;
  Absorb(std::move(rows));
  SolveState();
}

// A Householder reflection a column, on the column's diagonal element and the new rows only.
void KalmanFilter::Absorb(Eigen::MatrixXd rows) {
  const Eigen::Index n = x_.size();
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::VectorXd v = rows.col(k);
    if (v.squaredNorm() == 0) continue;
    const double diagonal = triangle_(k, k), norm = std::hypot(diagonal, v.norm());
    const double v0 = diagonal + std::copysign(norm, diagonal);
    const double beta = 2 / (v0 * v0 + v.squaredNorm());
    auto upper = triangle_.row(k).tail(n + 1 - k);
    auto lower = rows.rightCols(n + 1 - k);
    const Eigen::RowVectorXd s = beta * (v0 * upper + v.transpose() * lower);
    upper -= v0 * s;
    lower -= v * s;
  }
}

void KalmanFilter::SolveState() {
  const Eigen::Index n = x_.size();
  x_ = triangle_.leftCols(n).triangularView<Eigen::Upper>().solve(triangle_.col(n));
}

Estimate KalmanFilter::estimate() const { return EstimateAt(problem_, start_, Values(x_)); }

Eigen::MatrixXd KalmanFilter::covariance() const {
  const Eigen::Index n = x_.size();
  const Eigen::MatrixXd root =
      triangle_.leftCols(n).triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(n, n));
  return root * root.transpose();
}

Eigen::MatrixXd InitialCovariance(const Problem& problem, const std::vector<int>& active,
                                  const KalmanOptions& options) {
  const ParameterSet candidates = Candidates(problem);
  Eigen::VectorXd sd(static_cast<Eigen::Index>(active.size()));
  for (size_t k = 0; k < active.size(); ++k)
    sd(static_cast<Eigen::Index>(k)) = InitialDeviation(candidates[active[k]], options);
  return sd.cwiseAbs2().asDiagonal();
}

SolveSummary FilterKalman(const Problem& problem, const ModelError& model_error,
                          const std::vector<int>& active, const SolveOptions& options,
                          const Hooks& hooks, Estimate* estimate) {
  const Estimate start = *estimate;
  const WeightedProblem weighted(problem, model_error, active, start);
  const Eigen::MatrixXd P_0 = InitialCovariance(problem, active, options.kalman);
  const int passes = std::max(1, options.kalman.passes);
  SolveSummary summary;
  summary.initial_cost = summary.final_cost = weighted.Cost(weighted.Start());
  summary.covariance_approximate = passes == 1;
  std::optional<Eigen::VectorXd> end;
  while (summary.iterations < passes) {
    KalmanFilter filter(problem, active, start, P_0);
    if (end) filter.LineariseAt(*end);
    if (!Pass(weighted, hooks, &filter)) {
      summary.termination = Termination::kCancelled;
      return summary;
    }
    end = filter.state();
    summary.final_cost = weighted.Cost(*end);
    summary.covariance = filter.covariance();
    hooks.Report({"identification", 0, ++summary.iterations, summary.final_cost});
  }
  Judge(weighted, *end, &summary);
  if (summary.termination != Termination::kFailed) *estimate = weighted.At(*end);
  return summary;
}

}  // namespace truepose
