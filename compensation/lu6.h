// LU of a 6 x 6 matrix with row pivots, unrolled by the compiler: a third of the time of a general
// one.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <utility>

namespace truepose::compensation {

class Lu6 {
 public:
  // @returns false when a pivot is zero or not a number; Solve then means nothing.
  bool Factor(const Eigen::Matrix<double, 6, 6>& matrix) noexcept {
    for (int i = 0; i < 6; ++i) {
      row_[i] = i;
      for (int j = 0; j < 6; ++j) a_[i][j] = matrix(i, j);
    }
    return Eliminate<0>();
  }

  void Solve(const Eigen::Matrix<double, 6, 1>& b, double* x) const noexcept {
    double y[6];
    for (int i = 0; i < 6; ++i) {
      y[i] = b(row_[i]);
      for (int j = 0; j < i; ++j) y[i] -= a_[i][j] * y[j];
    }
    for (int i = 5; i >= 0; --i) {
      for (int j = i + 1; j < 6; ++j) y[i] -= a_[i][j] * y[j];
      y[i] *= inverse_pivot_[i];
    }
    for (int i = 0; i < 6; ++i) x[i] = y[i];
  }

 private:
  template <int k>
  bool Eliminate() noexcept {
    int best = k;
    for (int i = k + 1; i < 6; ++i) best = std::abs(a_[i][k]) > std::abs(a_[best][k]) ? i : best;
    if (!(std::abs(a_[best][k]) > 0)) return false;
    // Also with itself: a branch here would be guessed wrongly every other time.
    std::swap(row_[k], row_[best]);
    for (int j = 0; j < 6; ++j) std::swap(a_[k][j], a_[best][j]);
    inverse_pivot_[k] = 1 / a_[k][k];
    for (int i = k + 1; i < 6; ++i) {
      a_[i][k] *= inverse_pivot_[k];
      for (int j = k + 1; j < 6; ++j) a_[i][j] -= a_[i][k] * a_[k][j];
    }
    if constexpr (k < 5) return Eliminate<k + 1>();
    return true;
  }

  double a_[6][6];
  double inverse_pivot_[6];
  int row_[6];
};

}  // namespace truepose::compensation
