// Joints 1 to 3, each revolute or prismatic, that put a point into its place.
//
// With b the point in the frame of joint 3 as moved, g(q3) = C[2] Z_3(q3) b and y = Z_2(q2) g, it
// stands in the frame before joint 1 at w = Z_1(q1) C[1] y. C[1] = (R, p); lengths are over a unit
// of the arm's size.
//
// 1. Joint 1 leaves two functions of what it moves unchanged. Both read
//      s_i . y + k_i |y|^2 / 2 = c_i,   i = 1, 2                                              (1)
//    Revolute, the height and the squared distance:
//      s_1 = R^T z, k_1 = 0, c_1 = w_z - p_z;    s_2 = R^T p, k_2 = 1, c_2 = (|w|^2 - |p|^2) / 2
//    Prismatic, two coordinates across it, e_1 along axis 2 as seen from there and e_2 = z x e_1:
//      s_i = R^T e_i, k_i = 0, c_i = e_i . (w - p)
//
// 2. Joint 2 is eliminated. Revolute: |y| = |g|, y_z = g_z, and h = y_xy is g_xy turned by q2:
//      s_i,xy . h = E_i(q3) = c_i - s_i,z g_z - k_i |g|^2 / 2
//    A rotation of the two equations makes s_1,xy and s_2,xy orthogonal, of lengths m_1 >= m_2:
//      m_2^2 E_1^2 + m_1^2 E_2^2 = m_1^2 m_2^2 |g_xy|^2                                       (2)
//    with one h, so one q2, for each q3. m_2 = 0 when axis 2 lies in one plane with a revolute axis
//    1 or at right angles to a prismatic one: then
//      E_2(q3) = 0                                                                            (3)
//    and s_1,xy . h = E_1 has two q2.
//    Prismatic: y = g + q2 z. The first of (1) is linear, s_1,z q2 = c_1 - s_1 . g, and turns the
//    second into
//      s_2 . g + s_2,z q2 + k_2 (|g|^2 + 2 q2 g_z + q2^2) / 2 = c_2                           (4)
//    in q3 alone. s_1,z = 0 when axis 2 is at right angles to a revolute axis 1: then
//      s_1 . g = c_1                                                                          (5)
//    gives q3 and (4), of second degree, two q2.
//
// 3. With joint 3 revolute the coordinates of g and |g|^2 are first-order trigonometric polynomials
//    of q3; with joint 3 prismatic g is of first and |g|^2 of second degree. So the equations have
//      RRR, RPR, PRR  second order: 4 roots       RRP       degree 4: 4 roots
//      PPR            first order: 2 roots        PRP, RPP  degree 2: 2 roots      PPP  one root
//    and where (3) or (5) stands for (2) or (4) half the roots with two q2 each, or fewer.
//
// 4. q1 is the angle, or the length, from C[1] y to w.
#pragma once

#include <array>

#include "compensation/kinematics.h"

namespace truepose::compensation {

inline constexpr int kMaxPlacements = 8;

struct Placements {
  int count = 0;
  std::array<std::array<double, 3>, kMaxPlacements> q;  // chain joints 1 to 3; rad, m
};

// Whether they can put the point everywhere around some place: its motions by the three joints are
// independent somewhere. Otherwise it moves on a surface or less (axes 1 and 2 on one line, three
// parallel ones, three that meet, joint 3 through the point, prismatic joints in one plane).
// Decided at nine places, where the motions span more than 1e-4 (lengths over the characteristic
// one): what has less counts as none.
bool CanPlace(const JointChain& chain, const Eigen::Vector3d& b) noexcept;

// All places, to be polished and tested on the chain: near double roots they are right to 1e-4
// only, with axes within 1e-3 rad of m_2 = 0 or s_1,z = 0 to 5e-3, and some may be none there.
// @param b, w m; see above. @param q_reference chain joints that stand for revolute ones which a
// singular place leaves free: q1 where w is on axis 1, q2 where g is on axis 2.
Placements PlacementsOf(const JointChain& chain, const Eigen::Vector3d& b, const Eigen::Vector3d& w,
                        const double* q_reference) noexcept;

}  // namespace truepose::compensation
