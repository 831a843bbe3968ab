#include "core/drift/error_field.h"

#include <cmath>

namespace truepose {
namespace {

constexpr double kReach = 0.6;  // rad or m

using Entries = std::vector<Eigen::Triplet<double>>;

bool SameField(const Reading& a, const Reading& b) {
  return a.kind == b.kind && a.placement == b.placement && a.target == b.target &&
         RowsOf(a) == RowsOf(b) && a.coordinates == b.coordinates;
}

double ModelVariance(const Reading& reading, int row, const ModelError& error) {
  const double sd = row < PositionRowsOf(reading) ? error.position_sd_m : error.rotation_sd_rad;
  return sd * sd;
}

void AddOwn(const ResidualMatrix& R, int first, Entries* entries) {
  for (int i = 0; i < R.rows(); ++i)
    for (int j = 0; j < R.cols(); ++j)
      if (R(i, j) != 0) entries->emplace_back(first + i, first + j, R(i, j));
}

void AddPair(const Reading& reading, double rho, const ModelError& error, int a, int b,
             Entries* entries) {
  for (int i = 0; i < RowsOf(reading); ++i) {
    const double covariance = rho * ModelVariance(reading, i, error);
    entries->emplace_back(a + i, b + i, covariance);
    entries->emplace_back(b + i, a + i, covariance);
  }
}

}  // namespace

double FieldCorrelation(double d, int n) {
  return d < kReach ? std::pow(1 - d / kReach, n / 2 + 1) : 0;
}

FieldWhitener::FieldWhitener(const Problem& problem, const Estimate& estimate,
                             const ModelError& model_error) {
  Entries entries;
  std::vector<int> first;
  int rows = 0;
  for (size_t h = 0; h < problem.readings.size(); ++h) {
    const Reading& reading = problem.readings[h];
    AddOwn(CovarianceOf(problem, reading, estimate, model_error), rows, &entries);
    for (size_t k = 0; k < h; ++k) {
      const Reading& other = problem.readings[k];
      const double d = (reading.q - other.q).norm();
      if (d >= kReach || !SameField(reading, other)) continue;
      AddPair(reading, FieldCorrelation(d, static_cast<int>(reading.q.size())), model_error,
              first[k], rows, &entries);
    }
    first.push_back(rows);
    rows += RowsOf(reading);
  }
  Eigen::SparseMatrix<double> S(rows, rows);
  S.setFromTriplets(entries.begin(), entries.end());
  // Poses that repeat exactly without stated noise would leave S singular.
  for (int i = 0; i < rows; ++i) S.coeffRef(i, i) *= 1 + 1e-6;
  factor_.compute(S);
}

Eigen::MatrixXd FieldWhitener::Apply(const Eigen::MatrixXd& rows) const {
  const Eigen::MatrixXd permuted = factor_.permutationP() * rows;
  return factor_.permutationPinv() * Eigen::MatrixXd(factor_.matrixL().solve(permuted));
}

}  // namespace truepose
