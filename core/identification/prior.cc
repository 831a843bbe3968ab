#include "core/identification/prior.h"

#include <Eigen/Cholesky>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose {
namespace {

constexpr double kHarmonicSd_rad = 5.2359877559829887e-4;  // 0.03 deg
constexpr double kGainSd = 5e-4;

// Places in `identified` of the stored internal parameters that the model has.
std::vector<std::pair<int, int>> Places(const StoredCalibration& stored,
                                        const ParameterSet& parameters) {
  std::vector<std::pair<int, int>> places;
  for (size_t i = 0; i < stored.identified.size(); ++i) {
    const auto index = parameters.Find(stored.identified[i]);
    if (index) places.emplace_back(static_cast<int>(i), *index);
  }
  return places;
}

absl::Status CheckCovariance(const StoredCalibration& stored) {
  const Eigen::MatrixXd& C = stored.covariance;
  const auto n = static_cast<Eigen::Index>(stored.identified.size());
  if (C.rows() != n || C.cols() != n) {
    return FaultStatus("prior.covariance", absl::StrCat(C.rows(), " x ", C.cols()),
                       absl::StrCat(n, " x ", n, ", a row for each identified parameter"));
  }
  if (!C.allFinite())
    return FaultStatus("prior.covariance", "values that are not finite", "numbers");
  const double asymmetry = n == 0 ? 0 : (C - C.transpose()).cwiseAbs().maxCoeff();
  if (asymmetry > 1e-9 * (n == 0 ? 0 : C.cwiseAbs().maxCoeff()))
    return FaultStatus("prior.covariance", "a matrix that is not symmetric", "a covariance");
  return absl::OkStatus();
}

}  // namespace

Prior PriorOf(const TolerancePrior& tolerance, const ParameterSet& parameters) {
  std::vector<std::pair<int, double>> rows;
  for (int i = 0; i < parameters.size(); ++i) {
    if (parameters[i].role == ParameterRole::kEffect) continue;
    rows.emplace_back(
        i, 1 / (parameters[i].is_angle() ? tolerance.angle_sd_rad : tolerance.length_sd_m));
  }
  Prior prior{Eigen::VectorXd::Zero(parameters.size()),
              Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rows.size()), parameters.size())};
  for (size_t row = 0; row < rows.size(); ++row)
    prior.root(static_cast<Eigen::Index>(row), rows[row].first) = rows[row].second;
  return prior;
}

Prior NoPrior(const ParameterSet& parameters) {
  return {Eigen::VectorXd::Zero(parameters.size()), Eigen::MatrixXd::Zero(0, parameters.size())};
}

void AddEffectPrior(const ParameterSet& parameters, Prior* prior) {
  for (int i = 0; i < parameters.size(); ++i) {
    const Parameter& parameter = parameters[i];
    const bool bounded = parameter.unit == Unit::kRadian || parameter.unit == Unit::kRatio;
    if (parameter.role != ParameterRole::kEffect || !bounded || !prior->root.col(i).isZero(0))
      continue;
    const Eigen::Index row = prior->root.rows();
    prior->root.conservativeResizeLike(Eigen::MatrixXd::Zero(row + 1, parameters.size()));
    prior->root(row, i) = 1 / (parameter.is_angle() ? kHarmonicSd_rad : kGainSd);
  }
}

absl::StatusOr<Eigen::VectorXd> LambdaOf(const StoredCalibration& stored,
                                         const ParameterSet& parameters) {
  Eigen::VectorXd lambda = Eigen::VectorXd::Zero(parameters.size());
  FaultList faults;
  for (const auto& [name, value] : stored.internal) {
    const auto index = parameters.Find(name);
    if (!index) {
      if (value != 0)
        faults.Add(absl::StrCat("prior.internal_parameters[", name, "]"), "a name of another model",
                   "a calibration made with the same model and effects");
      continue;
    }
    lambda(*index) = value;
  }
  if (!faults.empty()) return faults.ToStatus();
  return lambda;
}

Eigen::MatrixXd InternalCovariance(const StoredCalibration& stored,
                                   const ParameterSet& parameters) {
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(parameters.size(), parameters.size());
  const auto places = Places(stored, parameters);
  for (const auto& [from_row, row] : places) {
    for (const auto& [from_col, col] : places) C(row, col) = stored.covariance(from_row, from_col);
  }
  return C;
}

absl::StatusOr<Prior> PriorOf(const StoredCalibration& stored, const ParameterSet& parameters) {
  TRUEPOSE_RETURN_IF_ERROR(CheckCovariance(stored));
  TRUEPOSE_ASSIGN_OR_RETURN(Eigen::VectorXd mean, LambdaOf(stored, parameters));
  const auto places = Places(stored, parameters);
  const auto k = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd C(k, k);
  for (Eigen::Index i = 0; i < k; ++i) {
    for (Eigen::Index j = 0; j < k; ++j)
      C(i, j) = stored.covariance(places[static_cast<size_t>(i)].first,
                                  places[static_cast<size_t>(j)].first);
  }
  // Scaled to ones on the diagonal, so that m and rad do not mix in the test of definiteness.
  const Eigen::VectorXd sd = C.diagonal().cwiseMax(0).cwiseSqrt();
  if (k > 0 && !(sd.minCoeff() > 0))
    return FaultStatus("prior.covariance", "a variance that is not positive", "positive variances");
  const Eigen::VectorXd scale = sd.cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> llt(scale.asDiagonal() * C * scale.asDiagonal());
  if (llt.info() != Eigen::Success)
    return FaultStatus("prior.covariance", "a matrix that is not positive definite",
                       "a covariance");
  const Eigen::MatrixXd inverse = llt.matrixL().solve(Eigen::MatrixXd(scale.asDiagonal()));
  Prior prior{std::move(mean), Eigen::MatrixXd::Zero(k, parameters.size())};
  for (Eigen::Index j = 0; j < k; ++j)
    prior.root.col(places[static_cast<size_t>(j)].second) = inverse.col(j);
  return prior;
}

}  // namespace truepose
