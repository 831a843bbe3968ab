// Rotations of 3-space as matrices, and their exponential coordinates. Templates on the scalar, so
// that tests can run them on Jets; nothing here allocates or fails.
//
// Conventions: R_AB turns coordinates in B into coordinates in A. A rotation vector r has direction
// of the axis and length of the angle in rad, |r| <= pi.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace truepose {

template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <typename T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;

// The matrix of w -> v x w.
template <typename T>
Matrix3<T> Hat(const Vector3<T>& v) {
  Matrix3<T> m;
  m << T(0), -v.z(), v.y(), v.z(), T(0), -v.x(), -v.y(), v.x(), T(0);
  return m;
}

// Quaternion (x, y, z, w) with w >= 0 of a rotation matrix, by the largest of its four components.
template <typename T>
Eigen::Matrix<T, 4, 1> QuaternionOf(const Matrix3<T>& R) {
  using std::sqrt;
  Eigen::Matrix<T, 4, 1> q;
  const T trace = R(0, 0) + R(1, 1) + R(2, 2);
  if (trace > T(0)) {
    const T s = sqrt(trace + T(1));
    q << R(2, 1) - R(1, 2), R(0, 2) - R(2, 0), R(1, 0) - R(0, 1), s * s;
    q /= T(2) * s;
  } else {
    int i = R(1, 1) > R(0, 0) ? 1 : 0;
    if (R(2, 2) > R(i, i)) i = 2;
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const T s = sqrt(R(i, i) - R(j, j) - R(k, k) + T(1));
    q(i) = s / T(2);
    q(j) = (R(j, i) + R(i, j)) / (T(2) * s);
    q(k) = (R(k, i) + R(i, k)) / (T(2) * s);
    q(3) = (R(k, j) - R(j, k)) / (T(2) * s);
  }
  if (q(3) < T(0)) q = -q;
  return q;
}

// Rotation matrix of a unit quaternion (x, y, z, w).
template <typename T>
Matrix3<T> RotationOf(const Eigen::Matrix<T, 4, 1>& q) {
  const T x = q(0), y = q(1), z = q(2), w = q(3), two(2);
  Matrix3<T> R;
  R << T(1) - two * (y * y + z * z), two * (x * y - z * w), two * (x * z + y * w),
      two * (x * y + z * w), T(1) - two * (x * x + z * z), two * (y * z - x * w),
      two * (x * z - y * w), two * (y * z + x * w), T(1) - two * (x * x + y * y);
  return R;
}

// Rotation vector of R. Exact near zero and near pi, since both go through the quaternion.
template <typename T>
Vector3<T> LogRotation(const Matrix3<T>& R) {
  using std::atan2;
  using std::sqrt;
  const Eigen::Matrix<T, 4, 1> q = QuaternionOf(R);
  const Vector3<T> v = q.template head<3>();
  const T squared = v.squaredNorm();
  // Below this the next term of atan is under the last bit, and the root has no derivative at zero.
  if (squared < T(1e-16)) return v * (T(2) / q(3));
  const T norm = sqrt(squared);
  return v * (T(2) * atan2(norm, q(3)) / norm);
}

// Rotation matrix of a rotation vector (Rodrigues), through the quaternion.
template <typename T>
Matrix3<T> ExpRotation(const Vector3<T>& r) {
  using std::cos;
  using std::sin;
  using std::sqrt;
  const T squared = r.squaredNorm();
  Eigen::Matrix<T, 4, 1> q;
  if (squared < T(1e-16)) {
    q << r / T(2), T(1) - squared / T(8);
  } else {
    const T angle = sqrt(squared);
    q << r * (sin(angle / T(2)) / angle), cos(angle / T(2));
  }
  return RotationOf(q);
}

// J_r^-1(r): Log(Exp(r) Exp(w)) = r + J_r^-1(r) w + O(w^2). Singular at |r| = 2 pi only.
inline Eigen::Matrix3d RightJacobianInverse(const Eigen::Vector3d& r) {
  const double squared = r.squaredNorm(), angle = std::sqrt(squared);
  // 1/a^2 - cot(a/2)/(2a), by its series where the two terms cancel.
  const double c = angle < 1e-3
                       ? 1.0 / 12 + squared / 720
                       : 1 / squared - std::cos(angle / 2) / (2 * angle * std::sin(angle / 2));
  const Eigen::Matrix3d h = Hat<double>(r);
  return Eigen::Matrix3d::Identity() + 0.5 * h + c * h * h;
}

// The rotation nearest to m in the Frobenius norm; m may be any matrix, also a reflection.
Eigen::Matrix3d NearestRotation(const Eigen::Matrix3d& m);

}  // namespace truepose
