// What arguments of the runtime have to be. A fault of them is an outcome, not a crash.
#pragma once

#include <Eigen/LU>
#include <cmath>

#include "compensation/arm.h"

namespace truepose::compensation {

inline bool AreFinite(const double* values, int count) noexcept {
  for (int i = 0; i < count; ++i) {
    if (!std::isfinite(values[i])) return false;
  }
  return true;
}

// One to kMaxJoints joints, and both chains of them.
inline bool IsArm(const Arm& arm) noexcept {
  return arm.nominal.joints >= 1 && arm.nominal.joints <= kMaxJoints &&
         arm.identified.joints == arm.nominal.joints;
}

// The first controller joint beyond its limits, also by what is no number, or -1.
inline int BeyondLimit(const Arm& arm, const double* q) noexcept {
  for (int i = 0; i < arm.nominal.joints; ++i) {
    if (!(q[i] >= arm.limits[i].lower && q[i] <= arm.limits[i].upper)) return i;
  }
  return -1;
}

// Of an arm with as many controller joints.
inline bool AreJoints(const Arm& arm, const double* q) noexcept {
  return IsArm(arm) && AreFinite(q, arm.nominal.joints);
}

// Finite, and R a rotation to 1e-6: what is further off was no rotation to begin with, nearer is
// how text gives one.
inline bool IsPose(const Pose& X) noexcept {
  const double off = (X.R.transpose() * X.R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  return X.p.allFinite() && X.R.allFinite() && off <= 1e-6 && X.R.determinant() > 0;
}

}  // namespace truepose::compensation
