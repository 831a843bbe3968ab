// One link of the extended D&H model: the matrix A_i that leads from frame i-1, whose z is the axis
// of joint i, to a frame i whose z is the axis of joint i+1 (Eqs. 14 to 20, 33).
//
//   D&H         R(z, theta) T(z, h) T(x, l) R(x, phi)        axes not parallel, Eq. 15
//   Hayati      R(z, theta) T(x, l) R(x, phi) R(y, beta)     parallel, joint i revolute, Eq. 16
//   PR          T(z, l) T(y, h) R(x, phi) R(y, beta)         parallel, joint i prismatic, Eq. 17
//   coincident  R(z, theta) T(x, a) T(y, b) R(x, alpha) R(y, beta)   parallel and nearer than 10 mm
// The last is the form of Eq. 33, since Hayati is singular at l = 0 (chapter-notes 6). All forms
// take axes that are only nearly parallel, with nominal values of phi and beta that are not zero,
// and axes in opposite directions (phi = 180 deg). l of D&H and Hayati is not negative: x points
// from axis to axis.
#pragma once

#include <vector>

#include "core/models/axis_lines.h"

namespace truepose {

// An elementary transform with its nominal value and the stem of its parameter: "theta" -> dtheta3.
struct LinkElement {
  Motion motion;
  Axis axis;
  double value;
  const char* stem;
  bool moves = false;  // the joint's motion is added here (Eq. 20; of PR it is l, chapter-notes 5)
};

using Link = std::vector<LinkElement>;

enum class LinkStart { kBase, kRevolute, kPrismatic };  // what moves at the link's first element

// The link from frame X_B,i-1 to the line of joint i+1, both with joints at zero.
Link LinkTo(const Pose& X, LinkStart start, const AxisLine& next);

// The last link, to the flange's origin (Eq. 19), with axes as those of frame n-1:
//   R6  R(z, gamma) R(y, beta) R(x, alpha) T(z, c) T(y, b) T(x, a)
//   P6  T(z, c) T(y, b) T(x, a) R(z, gamma) R(y, beta) R(x, alpha)
// with gamma = beta = alpha = 0 at nominal, where they are regular; what turns frame n into the
// flange is a constant behind them.
// @param p origin of the flange in frame n-1.
Link LastLink(JointType type, const Eigen::Vector3d& p);

// X * the link at its nominal values.
Pose After(Pose X, const Link& link);

}  // namespace truepose
