// The solver inside the loop that finds the weights.
#pragma once

#include "core/identification/identify.h"

namespace truepose {

// Solves, estimates s_model (unless known) and weighs the readings in turn until both stand; the
// last solve used the weights that are returned. Estimators other than Levenberg-Marquardt run
// once, from the same start and on the weights that it found: one objective, so that results
// compare.
// @param problem its readings' weights are written. @param result estimate and model_error are the
// start.
// @returns kCancelled. Not converging is in result->summary.
absl::Status SolveWithWeights(const std::vector<int>& active, const IdentifyOptions& options,
                              const Hooks& hooks, Problem* problem, Identification* result);

// robust.h's Consistency over the readings: their mean, as they seldom differ in their number of
// rows; 1 without a loss. @param problem at least one reading.
double MeanConsistency(Loss loss, const Problem& problem);

}  // namespace truepose
