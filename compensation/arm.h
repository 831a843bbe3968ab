// A robot arm as the runtime of compensation sees it: two chains of joints about or along z, the
// map from the controller's joints to the chains', limits and joint effects. Plain values in place:
// copied with memcpy, never allocating.
//
// A chain of n joints is
//   X_BF(q) = C[0] Z_1(q_1) C[1] Z_2(q_2) ... Z_n(q_n) C[n]
// with Z_i(q) a rotation about, or (prismatic) a translation along, the z axis of the frame before
// it. Every chain of elementary transforms can be written so: core/compensation/arm_from.h does.
//
// Joints are the controller's; the chains' are q_chain = joint_scale q + joint_offset. The
// identified flange stands at identified(joint_scale (q + effects(q)) + joint_offset), the nominal
// one at nominal(joint_scale q + joint_offset): the controller knows of no effects. Units m, rad,
// N, kg.
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>

#include "core/geometry/pose.h"

namespace truepose::compensation {

inline constexpr int kMaxJoints = 12;
inline constexpr int kMaxMasses = 16;

struct JointChain {
  int joints = 0;
  std::array<bool, kMaxJoints> prismatic{};
  std::array<Pose, kMaxJoints + 1> constant;  // C[0] to C[joints]; lengths in m
};

// Of a controller joint, rad or m; infinite where none is known.
struct JointLimits {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

// What a controller joint at reading q moves beside its reading:
//   gain q + sum_k cosine[k-1] cos(k q) + sine[k-1] sin(k q) + compliance tau,   k = 1, 2
// with tau the joint's load by gravity, N m or N. As core/models/effects.h, at the reference
// temperature.
struct HarmonicEffect {
  double gain = 0;
  std::array<double, 2> cosine{}, sine{};
  double compliance = 0;  // rad / (N m), or m / N of a prismatic joint
};

// A mass that moves with chain joint `joint` (from 0); its centre in B with all chain joints at
// zero, m. Up is the z axis of B.
struct PointMass {
  int joint = 0;
  double mass_kg = 0;
  Eigen::Vector3d centre_B = Eigen::Vector3d::Zero();
};

struct Arm {
  JointChain nominal;
  JointChain identified;  // parameter values folded into its constants
  Eigen::Matrix<double, kMaxJoints, kMaxJoints> joint_scale =  // top-left n x n, invertible
      Eigen::Matrix<double, kMaxJoints, kMaxJoints>::Identity();
  Eigen::Matrix<double, kMaxJoints, 1> joint_offset = Eigen::Matrix<double, kMaxJoints, 1>::Zero();
  std::array<JointLimits, kMaxJoints> limits;
  std::array<HarmonicEffect, kMaxJoints> effects;
  int masses = 0;  // of `mass`, for compliance; the load is that of the nominal chain
  std::array<PointMass, kMaxMasses> mass;
  bool measuring = false;  // joints in, corrected tip out; never commanded
};

}  // namespace truepose::compensation
