// Measured against commanded joints: with which of them the same model fits the same readings
// better.
//
// The calibration readings are taken with the other source's joints wherever there are any, and the
// same parameters are found anew with the same weights, by Levenberg-Marquardt from the result.
// Both fits have the same freedom, so that the RMS of the calibration readings compares them; the
// control set has no part in it. Costs a few iterations; start values, identifiable set and weights
// are those of the result.
#pragma once

#include <optional>

#include "absl/status/statusor.h"
#include "core/calibrate/calibrate.h"
#include "core/calibrate/sets.h"

namespace truepose {

// @param part the calibration readings of `whole`, with the prior of the run. @param result of it.
// @returns nullopt when no calibration reading has other joints, or the fit with them fails;
// kCancelled.
absl::StatusOr<std::optional<JointComparison>> CompareJointSources(const CalibrationProblem& whole,
                                                                   const Part& part,
                                                                   Estimator estimator,
                                                                   const Identification& result,
                                                                   const Hooks& hooks);

}  // namespace truepose
