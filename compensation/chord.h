// The way of almost every target of an arm with six joints: the corrected joints are milliradians
// away, so Newton with one inverted Jacobian contracts the error by about as much each step; the
// first step takes the curvature along, which makes it of third order.
#pragma once

#include "compensation/kinematics.h"

namespace truepose::compensation {

struct ChordOptions {
  double position_tolerance_m = 1e-10;
  double rotation_tolerance_rad = 1e-10;
  double characteristic_length_m = 1;
  // Steps that together are longer than this times the first remainder (lengths / characteristic
  // length) give up: something near a singularity for SolveLeastSquares to look at.
  double largest_gain = 100;
};

// Controller joints as moved by effects (`v`), and the chain's: start on entry, solution on
// success.
struct ChordState {
  JointArray v{};
  Motions motions;
  int iterations = 0;
  Twist remainder;
};

// Solves identified(joint_scale v + joint_offset) = desired for an arm of six joints. The Jacobian
// is taken afresh only when an error is not ten times smaller than the one before.
// @param state v and the motions of its chain joints.
// @returns false when a step is longer than kLongestSmallStep (rad; m), the gain too large, eight
// steps do not do, or a joint is beyond kLargestAngle (rad; m): then nothing in `state` is of use.
bool SolveByChords(const Arm& arm, const Pose& desired, const ChordOptions& options,
                   ChordState* state) noexcept;

}  // namespace truepose::compensation
