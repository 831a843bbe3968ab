#include "core/identification/fixture_error.h"

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <map>

#include "core/identification/prediction.h"

namespace truepose {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using FeatureKey = std::array<double, 3>;

FeatureKey KeyOf(const Reading& reading) {
  const Eigen::Vector3d& p =
      reading.kind == ObservationKind::kDistance ? reading.anchor_M : reading.X_MT.p;
  return {p.x(), p.y(), p.z()};
}

// Cholesky's lower L with S = L L'; coordinates that are exact have a column of zeros. Lower, so
// that an anchor, of which the position alone is stated, has the same L in its first three rows as
// a contact with the same feature.
Matrix6 LowerRoot(const Matrix6& S) {
  Matrix6 L = Matrix6::Zero();
  for (int j = 0; j < 6; ++j) {
    const double pivot = S(j, j) - L.row(j).squaredNorm();
    if (pivot <= 1e-12 * S(j, j)) continue;
    L(j, j) = std::sqrt(pivot);
    for (int i = j + 1; i < 6; ++i) L(i, j) = (S(i, j) - L.row(i).dot(L.row(j))) / L(j, j);
  }
  return L;
}

// D_h L: the residual by the feature's normed error. Moving the feature is moving the tool the
// other way; the sign is the same for all its readings.
Eigen::MatrixXd ByFeature(const Problem& problem, const Reading& reading,
                          const Estimate& estimate) {
  Residual r;
  ResidualByTwist D;
  KindOf(reading.kind).evaluate(reading, Predict(problem, reading, estimate), &r, &D);
  return D * LowerRoot(*reading.covariance);
}

}  // namespace

Eigen::MatrixXd FixtureCovariance(const Problem& problem, const Estimate& estimate,
                                  const ModelError& model_error, const WhitenedSystem& system,
                                  const std::vector<int>& active, const Eigen::MatrixXd& C) {
  std::map<FeatureKey, Eigen::MatrixXd> B;
  Eigen::Index row = 0;
  for (const Reading& reading : problem.readings) {
    const Eigen::Index rows = RowsOf(reading);
    if (reading.contact && reading.covariance && C.size() > 0) {
      const Eigen::MatrixXd J = system.J.middleRows(row, rows)(Eigen::all, active);
      Eigen::MatrixXd& sum =
          B.try_emplace(KeyOf(reading), Eigen::MatrixXd::Zero(J.cols(), 6)).first->second;
      sum += J.transpose() * (WhitenerOf(problem, reading, estimate, model_error) *
                              ByFeature(problem, reading, estimate));
    }
    row += rows;
  }
  if (B.empty()) return {};
  Eigen::MatrixXd common = Eigen::MatrixXd::Zero(C.rows(), C.cols());
  for (const auto& [key, sum] : B) common += (C * sum) * (C * sum).transpose();
  return common;
}

}  // namespace truepose
