// Inverse kinematics in closed form of six joints of which the last three are revolute with axes
// that meet in one point, the wrist centre W. The first three may be revolute or prismatic, with
// any constant geometry between them.
//
// The pose wanted says where W has to be. Joints 1 to 3 put it there in at most four ways
// (wrist_placement.h), and for each joints 4 to 6 turn the flange in two (wrist_turns.h): eight
// branches at most, but for singular places with joints left free.
#pragma once

#include "compensation/kinematics.h"

namespace truepose::compensation {

inline constexpr int kMaxWristBranches = 32;  // candidates: eight, and more near singularities

struct SphericalWrist {
  bool is_one = false;
  Eigen::Vector3d centre_3;  // behind Z_3, m
  Eigen::Vector3d centre_F;  // in the flange frame, m
};

// Six joints, the last three revolute with axes through one point to 1e-7 m, axis 5 not parallel to
// its neighbours, and joints 1 to 3 able to place the point (CanPlace of wrist_placement.h).
SphericalWrist SphericalWristOf(const JointChain& chain) noexcept;

struct WristBranches {
  int count = 0;
  std::array<JointArray, kMaxWristBranches> q;  // chain joints, revolute ones within half a turn
};

// Candidates of all branches, near double roots right to 1e-4 only (nearly degenerate arms 5e-3,
// wrist_placement.h): to be polished on the chain, and what does not converge there is none.
// @param q_reference chain joints that stand for those which a singular place leaves free (W on a
// revolute axis 1 or 2, a straight wrist).
WristBranches WristCandidates(const JointChain& chain, const SphericalWrist& wrist,
                              const Pose& X_BF, const double* q_reference) noexcept;

}  // namespace truepose::compensation
