// The three turns of a wrist whose axes meet: Z_4(q4) A Z_5(q5) B Z_6(q6) = M.
//
// Axes 4, 5 and 6 are the corners of a spherical triangle with sides alpha (4 to 5), beta (5 to 6)
// and theta (4 to 6, as M has it), whose angle at axis 5 follows q5: with delta = q5 less the q5
// at which axis 6 comes nearest to axis 4, gamma = alpha - beta and Gamma = alpha + beta
//   sin^2(delta / 2) : cos^2(delta / 2) = sin((theta + gamma) / 2) sin((theta - gamma) / 2)
//                                       : sin((Gamma + theta) / 2) sin((Gamma - theta) / 2)
// with two solutions +-delta. These products lose no digit where the wrist is straight (theta = 0
// or pi), as cos delta does: q5 would be right to 1e-8 there, and q4, which is the direction of an
// axis that is off by that, not at all. Then q4 turns A Z_5 B z onto M z, and q6 is what is left.
#pragma once

#include <Eigen/Core>
#include <array>

namespace truepose::compensation {

struct WristTurns {
  int count = 0;
  std::array<std::array<double, 3>, 4> q;  // q4, q5, q6, rad
};

// None when axis 6 can't come there; within 5e-5 in cos delta the place of closest approach.
// @param A, B rotations, axis 5 not parallel to its neighbours. @param q4_reference q4 where axes
// 4 and 6 are one line to 1e-12 rad. To 1e-6 rad there are solutions with it beside the true ones:
// M is not right to more when it comes from a double root of joints 1 to 3.
WristTurns WristTurnsOf(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B,
                        const Eigen::Matrix3d& M, double q4_reference) noexcept;

}  // namespace truepose::compensation
