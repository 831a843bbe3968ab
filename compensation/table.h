// A compensation table: the correction of an arm's flange on a grid over its joints, with what it
// is for, how well it was verified, and both chains of the arm.
//
// A node holds delta(q) = (t, r), t in m and r a rotation vector in rad, with
//   X_identified(q) X_nominal(q)^-1 = X_BL(q) E(q) X_BL(q)^-1,   E = (Exp(r), t),
//   X_identified(q) = X_BL(q) E(q) Z_n(q_n) C[n],
// where X_BL is the nominal chain up to before the motion Z_n of the last joint, taken at the
// nominal chain's joints q_chain = joint_scale q + joint_offset (effects move the identified one
// only). delta does not depend on the first joint when both chains agree before it, nor on the last
// when both agree behind it and it has no effect; such coordinates are folded. Unlike corrections
// of joints, delta stays small near singularities.
//
// Between nodes delta is interpolated linearly in each unfolded coordinate. Values below are SI.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compensation/arm.h"
#include "compensation/text.h"

namespace truepose::compensation {

inline constexpr std::uint32_t kTableSchema = 1;
inline constexpr int kNodeFloats = 6;  // t_x t_y t_z r_x r_y r_z

using Digest = std::array<std::uint8_t, 32>;  // SHA-256

// One coordinate u = sum_j weight[j] q_chain[j] of the domain. The weights are integers, and those
// of all n coordinates form a matrix of determinant +1 or -1, so the domain is a box of joints seen
// along other directions (q2 + q3 + q4 of an elbow arm).
struct TableAxis {
  std::array<double, kMaxJoints> weight{};
  // Targets outside [lower, upper] are refused. rad, or m where only prismatic joints take part.
  double lower = 0;
  double upper = 0;
  // The nodes stand at even steps from lower - margin to upper + margin. Corrected joints lie a
  // correction away from the target, where delta is looked up again: without a margin of at least
  // the largest correction of u, targets on the rim are refused.
  double margin = 0;
  // 1: folded, delta does not depend on u; its range is checked all the same, margin is not used.
  int nodes = 1;
};

// Errors of position m and of rotation rad that belong together.
struct PoseError {
  double position_m = 0;
  double rotation_rad = 0;
};

struct TableHeader {
  std::uint32_t schema = kTableSchema;
  Text robot;        // resource name
  Text serial;       // of the robot; empty where none is known
  Text calibration;  // resource name
  Digest calibration_digest{};
  Digest nominal_digest{};      // of the nominal robot
  std::int64_t created_us = 0;  // since 1970, UTC
  int joints = 0;               // n
  PoseError tolerance;          // asked for
  // What was found at verification_points points of the domain that are no nodes: how far the
  // identified flange at the corrected joints was from the nominal flange at the target. Points
  // near a singularity are refused, not counted.
  std::uint32_t verification_points = 0;
  PoseError worst;
  PoseError percentile_95;
  PoseError estimated_worst;           // before the table was built
  double predicted_accuracy_95_m = 0;  // of the tool, percentile_95 added; 0: not predicted
  double near_singular_share = 0;      // of drawn targets of the domain, 0 to 1
  // Correction to joints is refused where the smallest singular value of the nominal Jacobian
  // (B to F, lengths divided by characteristic_length_m, turning joints in rad and sliding ones
  // divided by it) is below this.
  double smallest_singular_value = 0;
  double characteristic_length_m = 1;
};

// A whole table as the builder fills it and Encode writes it.
struct TableContent {
  TableHeader header;
  Arm arm;
  std::array<TableAxis, kMaxJoints> axis;  // the first header.joints
  // kNodeFloats for each node of the grid over all axes, the last axis fastest.
  std::vector<float> nodes;
};

}  // namespace truepose::compensation
