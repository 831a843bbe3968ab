// Nominal inverse kinematics of any chain.
//
// Six joints of which the last three are revolute with axes that meet, the first three revolute or
// prismatic: closed form (spherical_wrist.h), all branches.
// Any other chain: damped Newton from the reference and from seeded draws over the limits; all
// branches that are found. With more than six joints a branch is the solution nearest to the
// reference within its null space; with fewer it is a least remainder (exact.h), of which only the
// least ones count. Whole turns of joints that change nothing are taken out near the reference, or
// put in where a limit asks for it.
#pragma once

#include <cstdint>

#include "compensation/exact.h"
#include "compensation/least_squares.h"

namespace truepose::compensation {

inline constexpr int kMaxBranches = 16;

struct InverseOptions : ExactOptions {
  int starts = 100;  // of damped Newton
  std::uint64_t seed = 1;
  // A solution that damped Newton finds this near to the seed is taken for the nearest: rad, or
  // characteristic lengths.
  double near = 1;
};

struct Branches {
  Outcome outcome = Outcome::kInvalidArgument;  // kOk: at least one; kBeyondLimit, kUnreachable
  bool closed_form = false;                     // then all there are
  int joint = -1;                               // of kBeyondLimit
  int count = 0;
  std::array<JointArray, kMaxBranches> q{};  // controller joints, nearest to the reference first
  Correction best;  // of any start: where the nominal chain comes nearest, also beyond a limit
};

// All branches within the limits at which the nominal flange is at X_BF.
Branches AllBranches(const Arm& arm, const Pose& X_BF, const double* q_reference,
                     const InverseOptions& options) noexcept;

// The branch nearest to `q_seed`: the one that damped Newton reaches from there when it stays near,
// else the nearest of AllBranches. Errors are those of the nominal chain; with kUnreachable and
// kBeyondLimit at the best place found.
Correction NearestBranch(const Arm& arm, const Pose& X_BF, const double* q_seed,
                         const InverseOptions& options) noexcept;

// The least-squares task of `chain` (the arm's nominal or identified one) by these options.
LeastSquaresTask TaskOf(const Arm& arm, const JointChain& chain, const Pose& X_BF,
                        const ExactOptions& options) noexcept;

}  // namespace truepose::compensation
