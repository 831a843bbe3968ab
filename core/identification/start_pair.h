// Start values of one placement and one target.
#pragma once

#include <optional>

#include "core/identification/problem.h"

namespace truepose {

// What of a pair stays as it is.
struct PairKnown {
  std::optional<Pose> X_MB, X_FT;
  std::vector<std::optional<double>> offsets;  // one of each of the pair's offsets
};

// Guesses (start_candidates.h; start_partial.h where fewer than four readings show a point), the
// best by cost refined by least squares on at most 60 readings, the best of those on all.
// Frames known and readings all of points are not refined: the linear start is as good.
// @param pair with one placement and one target. @param X_FT nominal target, tried first.
Estimate SolvePair(const Problem& pair, const PairKnown& known, const std::optional<Pose>& X_FT);

// The unknown constants that fit best at the frames of an estimate: means of what the distances are
// too long. Those with a value in `known` take it.
void SetOffsets(const Problem& problem, const std::vector<std::optional<double>>& known,
                Estimate* estimate);

}  // namespace truepose
