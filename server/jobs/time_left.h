// How long a run will go on, from how long it took so far.
#pragma once

#include <optional>

#include "absl/time/time.h"

namespace truepose::jobs {

// used * (1 - fraction) / fraction, in seconds: the rest goes on as fast as what is done.
// Nothing below 2 % or without any time used: there the estimate says more of the clock than of the
// run.
std::optional<double> SecondsLeft(absl::Duration used, double fraction);

}  // namespace truepose::jobs
