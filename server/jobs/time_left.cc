#include "server/jobs/time_left.h"

#include <algorithm>

namespace truepose::jobs {

std::optional<double> SecondsLeft(absl::Duration used, double fraction) {
  constexpr double kLeastFraction = 0.02;
  // Negated so that NaN goes this way, too.
  if (!(fraction >= kLeastFraction) || used <= absl::ZeroDuration()) return std::nullopt;
  return absl::ToDoubleSeconds(used) * (1 - std::min(fraction, 1.0)) / fraction;
}

}  // namespace truepose::jobs
