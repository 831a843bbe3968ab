// What arguments of the runtime have to be. A fault of them is an outcome, not a crash.
#pragma once

#include <cmath>

#include "core/geometry/pose.h"

namespace truepose::compensation {

inline bool AreFinite(const double* values, int count) noexcept {
  for (int i = 0; i < count; ++i) {
    if (!std::isfinite(values[i])) return false;
  }
  return true;
}

// Finite, and R a rotation to 1e-6: what is further off was no rotation to begin with, nearer is
// how text gives one.
inline bool IsPose(const Pose& X) noexcept {
  const double off = (X.R.transpose() * X.R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  return X.p.allFinite() && X.R.allFinite() && off <= 1e-6 && X.R.determinant() > 0;
}

}  // namespace truepose::compensation
