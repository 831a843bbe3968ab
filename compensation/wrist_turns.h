// The three turns of a wrist whose axes meet: Z_4(q4) A Z_5(q5) B Z_6(q6) = M.
//
// The z axis of M over axis 4 is as high as q5 lifts it: a cos q5 + b sin q5 = M_zz - A_zz B_zz,
// with two solutions. Then q4 turns A Z_5 B z onto M z, and q6 is what is left.
#pragma once

#include <Eigen/Core>
#include <array>

namespace truepose::compensation {

struct WristTurns {
  int count = 0;
  std::array<std::array<double, 3>, 2> q;  // q4, q5, q6, rad
};

// Near a double root right to 1e-4 only, and just beyond it the place of closest approach.
// @param A, B rotations, axis 5 not parallel to its neighbours. @param q4_reference q4 where axes
// 4 and 6 are one line.
WristTurns WristTurnsOf(const Eigen::Matrix3d& A, const Eigen::Matrix3d& B,
                        const Eigen::Matrix3d& M, double q4_reference) noexcept;

}  // namespace truepose::compensation
