// A check session against the active calibration: has anything changed, and which part is it.
//
// "Changed" is a probability below 0.01 (drift_tests.h). A part is named when, beside that,
//   - its own drop is significant at 0.01 among all parts (Bonferroni);
//   - its BIC (-drop / scale + k ln(rows), least is best) is the least by at least 2;
//   - what all parts together explain beyond it is not significant at 0.001: else more than one
//     part has changed (two are looked for, drift_pairs.h), or something that is no part.
// Base is a part only where the check's frame of the instrument is that of the calibration, tool
// only where the target is: the caller says so with base_held and tool_held. Where not, the frame
// is fitted to the check, and the findings say that it can't be observed.
#pragma once

#include "absl/status/statusor.h"
#include "core/base/hooks.h"
#include "core/drift/drift_problem.h"

namespace truepose {

// Of a check with more readings this many are judged, evenly spaced: a few dozen are enough, and
// the whole covariance of thousands is not.
inline constexpr int kMostCheckReadings = 400;

// @returns kInvalidArgument with faults of `readings` for none, or of `covariance` for a wrong
// size; kFailedPrecondition with a fault of `readings` when there are not more measured values than
// unknowns, those of all parts together; errors of FindStart for frames that are not held;
// kCancelled.
absl::StatusOr<DriftCheckResult> CheckDrift(const DriftProblem& problem, const Hooks& hooks = {});

}  // namespace truepose
