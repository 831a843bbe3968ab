// How a correction ended. Nothing here is an exception: what was reached is always given beside the
// reason why it is not what was asked for.
#pragma once

#include <array>

#include "compensation/arm.h"

namespace truepose::compensation {

enum class Outcome {
  kOk,
  // Exact joints do not exist near the nominal ones, or lie far from them: the nominal or the
  // corrected place is nearer to a singularity than allowed.
  kNearSingular,
  kBeyondLimit,  // exact joints would be beyond the limit of Correction::joint
  kUnreachable,  // no joints bring the flange there
  kOutsideDomain,
  kInvalidArgument,  // not a number, or a measuring arm that was to be commanded
};

// "ok", "near_singular", "beyond_limit", "unreachable", "outside_domain", "invalid_argument".
const char* Name(Outcome outcome) noexcept;

using JointArray = std::array<double, kMaxJoints>;

// With any outcome but kOk `q` is the best that was found within the limits, not to be commanded
// without a look at the errors; with kInvalidArgument it means nothing.
struct Correction {
  Outcome outcome = Outcome::kInvalidArgument;
  int joint = -1;  // of kBeyondLimit, or axis of kOutsideDomain; from 0
  int iterations = 0;
  double position_error_m = 0;  // left at q, by the identified chain
  double rotation_error_rad = 0;
  double smallest_singular_value = -1;  // at q, lengths / characteristic length; -1: not looked at
  JointArray q{};                       // controller joints
};

}  // namespace truepose::compensation
