// Choice of geometric parameters by the calibration readings (identification/selection.h).
#pragma once

#include "core/identification/identify.h"
#include "core/identification/selection.h"

namespace truepose {

// The base set is what the chapter's operators chose by eye: base, tool, constants, joint offsets
// and lengths. Each of the other identified parameters is a candidate.
// @param full identification of everything that the readings determine.
// Cross-validation has as many folds as there are rows where those are fewer than `options.folds`.
// @returns kCancelled, kInvalidArgument when there are fewer than two rows for folds, or
// kFailedPrecondition for folds of cross-validation that don't determine the base set. `active` of
// the result is what to identify.
absl::StatusOr<SelectionResult> ChooseParameters(const Problem& problem, const Identification& full,
                                                 const Estimate& start,
                                                 const SelectionOptions& options,
                                                 const Hooks& hooks);

}  // namespace truepose
