// Poses X_AB: where frame B stands in frame A. p_A = X_AB * p_B, X_AC = X_AB * X_BC. Lengths in m.
#pragma once

#include <Eigen/Core>

#include "core/geometry/rotation.h"

namespace truepose {

template <typename T>
struct PoseT {
  Matrix3<T> R = Matrix3<T>::Identity();
  Vector3<T> p = Vector3<T>::Zero();
};

using Pose = PoseT<double>;

template <typename T>
PoseT<T> operator*(const PoseT<T>& X_AB, const PoseT<T>& X_BC) {
  return {X_AB.R * X_BC.R, X_AB.R * X_BC.p + X_AB.p};
}

template <typename T>
Vector3<T> operator*(const PoseT<T>& X_AB, const Vector3<T>& p_B) {
  return X_AB.R * p_B + X_AB.p;
}

template <typename T>
PoseT<T> Inverse(const PoseT<T>& X_AB) {
  return {X_AB.R.transpose(), -(X_AB.R.transpose() * X_AB.p)};
}

// The rotation best aligning and the translation: X_AB that minimises sum |a_i - X_AB b_i|^2
// (Kabsch).
// @param a, b points as columns, 3 x k, k >= 1. With collinear points the rotation about their line
// is arbitrary.
Pose AlignPoints(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b);

}  // namespace truepose
