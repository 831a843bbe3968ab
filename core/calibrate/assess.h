// What a calibration says of itself once the parameters are found.
#pragma once

#include "core/calibrate/calibrate.h"
#include "core/calibrate/sets.h"

namespace truepose {

// Fills everything of a result that follows from its model, `before` and `identification`: frames
// of the whole, sets, suspects, correlations, predicted accuracy, places, verdict.
// @returns kCancelled.
absl::Status Assess(const CalibrationProblem& problem, const Part& part, const Hooks& hooks,
                    CalibrationResult* result);

}  // namespace truepose
