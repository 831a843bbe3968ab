// Nominal joints along a path of poses in one configuration.
#pragma once

#include "compensation/inverse.h"

namespace truepose::compensation {

struct PathEnd {
  // kOk: the whole path. kNearSingular: it meets a singularity, where the configuration would
  // change. kBeyondLimit: `joint` meets its limit. kUnreachable: a pose is out of reach.
  Outcome outcome = Outcome::kInvalidArgument;
  int joint = -1;
  int followed = 0;  // poses that have joints
  double share = 0;  // of the way from the last of these to the next where it ends
  // The pose that was not followed can be reached within the limits, but only in another
  // configuration or by another whole turn.
  bool needs_other_branch = false;
  double smallest_singular_value = -1;  // least along the way that was looked at
};

// Between two poses the flange goes straight and turns about one axis; the way is taken in pieces
// in which no joint moves by more than 0.2 (rad or characteristic lengths), each by damped least
// squares from the one before. Six joints: a change of the sign of the Jacobian's determinant is a
// singularity passed. The first pose takes the branch nearest to q_start.
// @param q out, `count` of them; those beyond PathEnd::followed are left as they are.
PathEnd FollowPath(const Arm& arm, const Pose* X_BF, int count, const double* q_start,
                   const InverseOptions& options, JointArray* q) noexcept;

}  // namespace truepose::compensation
