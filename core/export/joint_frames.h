// A frame on each joint axis, and the robot as the constant poses between them:
//   X_BF(q) = X_B1 D(q_1) X_12 D(q_2) ... D(q_n) X_nF,  D(q) = R(z, q) or T(z, q).
// URDF and UR's calibration file are lists of these poses.
#pragma once

#include <vector>

#include "core/export/home.h"

namespace truepose {

// The frame on `axis` that is nearest to X_BN: z is the axis, x is N's x (N's z where x is nearly
// along the axis) without its part along the axis, the origin is the point of the axis nearest to
// N's origin; a prismatic axis goes through N's origin.
Pose FrameOn(const JointAxis& axis, const Pose& X_BN);

// X_B1 ... X_Bn, each nearest to the one before, the first to B. No common normal of two axes is
// needed, so nearly parallel axes give no distant frames.
std::vector<Pose> FramesAlong(const Home& home);

// X_B1, X_12, ..., X_nF: n + 1 poses.
std::vector<Pose> PosesBetween(const std::vector<Pose>& frames, const Pose& X_BF);

// R = R(z, yaw) R(y, pitch) R(x, roll), URDF's `rpy` about fixed axes x, y, z. Exact also where
// pitch is a quarter turn, and roll and yaw are not both determined. Values below 1e-15 are 0.
struct RollPitchYaw {
  double roll, pitch, yaw;  // rad
};
RollPitchYaw RollPitchYawOf(const Eigen::Matrix3d& R);

}  // namespace truepose
