// The inverse of a 6 x 6 matrix for systems that a chord solves a few times, without pivots: no
// branch that a processor guesses wrongly, and two divisions in all.
//
// x = J^-1 e = J^T y with (J J^T) y = e. J J^T = (A B^T; B C) is positive definite; with
// G = B A^-1 and S = C - G B^T its Schur complement,
//   y2 = S^-1 (e2 - G e1),  y1 = A^-1 e1 - G^T y2,
// A^-1 and S^-1 by cofactors. Rounding counts with the square of the condition: x is right to about
// 1e-15 cond^2 (cond^4 where two singular values are small), which a chord makes up for as long as
// that is far below 1. Beyond, x may be of any size and wrong: see what Unsolved says, or what the
// step has done.
#pragma once

#include <Eigen/Core>

namespace truepose::compensation {

class Inverse6 {
 public:
  using Matrix6 = Eigen::Matrix<double, 6, 6>;

  // @returns false when the matrix is seen to be singular or not finite; Solve then means nothing.
  // Of what is singular to rounding about half is seen.
  bool Set(const Matrix6& matrix) noexcept {
    J_ = matrix;
    Eigen::Matrix3d A, B, C;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        A(i, j) = Product(i, j);
        B(i, j) = Product(3 + i, j);
        C(i, j) = Product(3 + i, 3 + j);
      }
    }
    const bool is_positive = Invert(A, &inverse_A_);
    G_ = B.lazyProduct(inverse_A_);
    return Invert(C - G_.lazyProduct(B.transpose()), &inverse_S_) && is_positive;
  }

  void Solve(const Eigen::Matrix<double, 6, 1>& b, double* x) const noexcept {
    const Eigen::Vector3d e1 = b.head<3>(), e2 = b.tail<3>();
    const Eigen::Vector3d y2 = inverse_S_.lazyProduct(e2 - G_.lazyProduct(e1));
    const Eigen::Vector3d y1 = inverse_A_.lazyProduct(e1) - G_.transpose().lazyProduct(y2);
    for (int j = 0; j < 6; ++j) {
      x[j] = 0;
      for (int i = 0; i < 3; ++i) x[j] += J_(i, j) * y1(i) + J_(3 + i, j) * y2(i);
    }
  }

  // b - J x.
  Eigen::Matrix<double, 6, 1> Unsolved(const Eigen::Matrix<double, 6, 1>& b,
                                       const double* x) const noexcept {
    return b - J_.lazyProduct(Eigen::Map<const Eigen::Matrix<double, 6, 1>>(x));
  }

  // Of the inverse, which is the trace of (J J^T)^-1: 1 over it is at most the matrix' smallest
  // singular value squared, and at least a sixth of that.
  double SquaredNorm() const noexcept {
    const Eigen::Matrix3d SG = inverse_S_.lazyProduct(G_);
    return inverse_A_.trace() + inverse_S_.trace() + SG.cwiseProduct(G_).sum();
  }

 private:
  double Product(int i, int j) const noexcept {
    double sum = 0;
    for (int k = 0; k < 6; ++k) sum += J_(i, k) * J_(j, k);
    return sum;
  }

  // Of a symmetric matrix. @returns whether it is positive definite (all leading minors are).
  static bool Invert(const Eigen::Matrix3d& M, Eigen::Matrix3d* inverse) noexcept {
    const double a = M(0, 0), b = M(1, 0), c = M(2, 0), d = M(1, 1), e = M(2, 1), f = M(2, 2);
    const double A = d * f - e * e, B = c * e - b * f, C = b * e - c * d;
    const double D = a * f - c * c, E = b * c - a * e, F = a * d - b * b;
    const double determinant = a * A + b * B + c * C, s = 1 / determinant;
    *inverse << A * s, B * s, C * s, B * s, D * s, E * s, C * s, E * s, F * s;
    return a > 0 && F > 0 && determinant > 0;
  }

  Matrix6 J_;
  Eigen::Matrix3d inverse_A_, inverse_S_, G_;
};

}  // namespace truepose::compensation
