// What must hold of a calibration problem and of its identification.
#pragma once

#include "core/calibrate/calibrate.h"

namespace truepose {

// kInvalidArgument: no reading, roles that do not match, no calibration row.
absl::Status CheckProblem(const CalibrationProblem& problem);

// kFailedPrecondition when there are not more measured values than parameters; a prior's count.
absl::Status CheckRedundancy(const Identification& identification);

// kFailedPrecondition with a fault for each parameter that other readings would determine.
absl::Status CheckComplete(const IdentifiableSet& set, const ParameterSet& candidates);

}  // namespace truepose
