// A frame that is fitted to the readings: X_MB of a placement or X_FT of a target.
//
// Its six corrections d = (x, y, z, rx, ry, rz) are elementary transforms like every other
// parameter:
//   X(d) = T(p0 + d_xyz) R(x, rx) R(y, ry) R(z, rz) R0
// so d_xyz is along the axes of the frame's own base and d_r turns about axes parallel to those,
// through the frame's origin: position and rotation of a frame 3 m away are not mixed. After a fit
// the frame is moved to X(d) and d is 0.
#pragma once

#include <Eigen/Core>
#include <string>
#include <string_view>

#include "core/geometry/pose.h"
#include "core/parameters/parameter_set.h"

namespace truepose {

inline constexpr int kFrameParameters = 6;

using FrameJacobian = Eigen::Matrix<double, 6, kFrameParameters>;

// X(d) of the frame X.
// @param d six values: m, m, m, rad, rad, rad.
// @param J nullptr, or the twists of the six corrections at the origin of the frame's base.
Pose Corrected(const Pose& X, const double* d, FrameJacobian* J);

// "base.x" ... "base.rz"; with a label "base[label].x".
Parameter FrameParameter(ParameterGroup group, std::string_view label, int index);
// The index of a parameter of a base or tool frame.
int CorrectionOf(const Parameter& parameter);

}  // namespace truepose
