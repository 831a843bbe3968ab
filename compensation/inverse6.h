// The inverse of a 6 x 6 matrix, for systems that are solved more than once: a product with it does
// not wait from unknown to unknown as substitution does.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <utility>

namespace truepose::compensation {

// Gauss and Jordan in place on the transposed matrix, rows exchanged for the largest pivot. At the
// end a_[i][j] is element (row_[j], i) of the inverse.
class Inverse6 {
 public:
  // @returns false when a pivot is zero or not a number; Solve then means nothing.
  bool Set(const Eigen::Matrix<double, 6, 6>& matrix) noexcept {
    for (int i = 0; i < 6; ++i) {
      row_[i] = i;
      for (int j = 0; j < 6; ++j) a_[i][j] = matrix(j, i);
    }
    return Eliminate<0>();
  }

  void Solve(const Eigen::Matrix<double, 6, 1>& b, double* x) const noexcept {
    double y[6] = {};
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) y[j] += a_[i][j] * b(i);
    }
    for (int j = 0; j < 6; ++j) x[row_[j]] = y[j];
  }

  // Of the inverse: 1 over it is at most the matrix' smallest singular value, and at least that
  // over the root of 6.
  double SquaredNorm() const noexcept {
    double sum = 0;
    for (int i = 0; i < 6; ++i) {
      for (int j = 0; j < 6; ++j) sum += a_[i][j] * a_[i][j];
    }
    return sum;
  }

 private:
  template <int k>
  bool Eliminate() noexcept {
    int best = k;
    for (int i = k + 1; i < 6; ++i) best = std::abs(a_[i][k]) > std::abs(a_[best][k]) ? i : best;
    if (!(std::abs(a_[best][k]) > 0)) return false;
    if (best != k) {
      std::swap(row_[k], row_[best]);
      for (int j = 0; j < 6; ++j) std::swap(a_[k][j], a_[best][j]);
    }
    const double inverse = 1 / a_[k][k];
    a_[k][k] = 1;
    for (int j = 0; j < 6; ++j) a_[k][j] *= inverse;
    for (int i = 0; i < 6; ++i) {
      if (i == k) continue;
      const double share = a_[i][k];
      a_[i][k] = 0;
      for (int j = 0; j < 6; ++j) a_[i][j] -= share * a_[k][j];
    }
    if constexpr (k < 5) return Eliminate<k + 1>();
    return true;
  }

  double a_[6][6];
  int row_[6];
};

}  // namespace truepose::compensation
