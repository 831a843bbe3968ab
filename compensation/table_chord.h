// The usual way of a correction by table: six joints, Newton with one inverted Jacobian.
#pragma once

#include "compensation/kinematics.h"
#include "compensation/lookup.h"
#include "compensation/outcome.h"

namespace truepose::compensation {

enum class ChordEnd {
  kReached,
  kOutside,  // corrected joints have left the margin of the table's axis
  kGivenUp,  // near a singularity, or steps are long or do not contract: for the slow way
};

struct TableChord {
  JointArray q_chain{};  // the target's on entry, the solution with kReached
  Delta delta;           // of the target, on entry
  int iterations = 0;
  int axis = -1;                    // of kOutside
  Twist remainder = Twist::Zero();  // with kReached; where the last step was not looked at, a twist
                                    // whose two norms are bounds
};

// @pre table.header.joints is 6
ChordEnd CorrectByChords(const Table& table, TableChord* state) noexcept;

// What is nothing to a table (correct_by_table.h), and what a lookup rounds to float.
struct TableTolerance {
  double position_m, rotation_rad;

  // @param delta  the correction at the target
  TableTolerance(const Table& table, const Delta& delta) noexcept;
  bool IsMet(const Twist& remainder) const noexcept;
};

}  // namespace truepose::compensation
