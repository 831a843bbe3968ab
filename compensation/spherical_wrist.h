// Inverse kinematics in closed form of six revolute joints whose last three axes meet in one point,
// the wrist centre W, whatever the first three axes are.
//
// With b = W in the frame of joint 3 as moved and g(q3) = C[2] Z_3(q3) b, the wrist centre in the
// frame before joint 1 is w = Z_1(q1) (C[1] (Z_2(q2) g)). Neither its height w_z nor |w|^2 depends
// on q1, and both are linear in h = the xy part of Z_2(q2) g:
//   r . h = A(q3) = w_z - p_z - r_z g_z          r = third row of the rotation of C[1], p its shift
//   d . h = B(q3) = (|w|^2 - |p|^2 - |g|^2) / 2 - d_z g_z              d = R^T p
//   |h|^2 = |g_xy|^2
// A and B are first-order trigonometric polynomials of q3, |g_xy|^2 is of second order. The 2 x 2
// matrix (r; d) is constant, so with k its determinant (how far axes 1 and 2 are from lying in one
// plane) |(r; d)^-1 (A, B)|^2 = |g_xy|^2 is a second-order polynomial in q3: at most four q3, each
// with one q2. Where axes 1 and 2 lie in one plane, k = 0 and one combination of A and B vanishes:
// at most two q3 with two q2 each. Then q1 from w, and the wrist's q5 from
// a cos q5 + b sin q5 = c with two solutions, q4 and q6. Eight branches at most.
#pragma once

#include "compensation/kinematics.h"

namespace truepose::compensation {

inline constexpr int kMaxWristBranches = 32;  // candidates: eight and doubles of double roots

struct SphericalWrist {
  bool is_one = false;
  Eigen::Vector3d centre_3;  // behind Z_3, m
  Eigen::Vector3d centre_F;  // in the flange frame, m
};

// Six revolute joints, the last three axes through one point to 1e-7 m, axis 5 not parallel to its
// neighbours, and joints 1 to 3 able to place the point (axes 1 and 2 not one line, joint 3 not
// through W).
SphericalWrist SphericalWristOf(const JointChain& chain) noexcept;

struct WristBranches {
  int count = 0;
  std::array<JointArray, kMaxWristBranches> q;  // chain joints within half a turn of zero
};

// Candidates of all branches, near double roots right to 1e-4 only: to be polished on the chain,
// and what does not converge there is none. @param q_reference chain joints that stand for those
// which a singular place leaves free (W on axis 1 or 2, a straight wrist).
WristBranches WristCandidates(const JointChain& chain, const SphericalWrist& wrist,
                              const Pose& X_BF, const double* q_reference) noexcept;

}  // namespace truepose::compensation
