// Whether all singular values of a 6 x 6 matrix are above a bound, without finding them.
#pragma once

#include <Eigen/Core>

namespace truepose::compensation {

// J J^T - bound^2 I is positive definite just when they are: all pivots of its elimination are
// above zero. Right to about 1e-8 of the largest singular value.
inline bool SingularValuesAreAbove(const Eigen::Matrix<double, 6, 6>& J, double bound) noexcept {
  double a[6][6];  // the lower triangle
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) a[i][j] = J.row(i).dot(J.row(j));
    a[i][i] -= bound * bound;
  }
  for (int k = 0; k < 6; ++k) {
    if (!(a[k][k] > 0)) return false;
    const double inverse = 1 / a[k][k];
    for (int i = k + 1; i < 6; ++i) {
      const double share = a[i][k] * inverse;
      for (int j = k + 1; j <= i; ++j) a[i][j] -= share * a[j][k];
    }
  }
  return true;
}

}  // namespace truepose::compensation
