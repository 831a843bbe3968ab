// Any robot as standard D&H rows A = R(z, theta) T(z, d) T(x, a) R(x, alpha), Eq. 15:
//   X_BF(q) = A_0 A_1(q_1) ... A_n(q_n) R(z, flange_theta) T(z, flange_d),
// A_0 constant: it carries B's z axis to the axis of joint 1.
//
// Row i goes by the common normal of the axes of joints i and i+1 (of B's z before, of F's z behind
// the last): alpha and a are the angle and distance between them, d and theta where the normal
// meets axis i. Of its two directions that with theta within about a quarter turn is taken. Where
// the axes are
//   parallel (within 1e-10 rad): d = 0; the error of taking them so is 1e-10 of the lengths behind;
//   coincident: theta = d = a = 0 and alpha = 0 or pi;
//   nearly parallel, as nominally parallel axes are when identified: the normal is far away, d
//     grows with the inverse of the angle. The table stays exact, but is no good to read or to
//     calibrate (chapter, Sec. 5; Hayati).
// A prismatic axis has a direction only: it goes through the nearest point of the next revolute
// axis, or through F's origin. Behind the last joint, theta and d that the flange does not need
// apart are part of its row, so that a robot given by a D&H table gets this table back.
#pragma once

#include <vector>

#include "core/export/home.h"
#include "core/robot/dh.h"

namespace truepose {

struct DhTable {
  DhRow base;               // A_0; all 0 when joint 1 is along B's z
  std::vector<DhRow> rows;  // a row a joint, at joint value 0
  double flange_theta = 0, flange_d = 0;
};

DhTable DhTableOf(const Home& home);

}  // namespace truepose
