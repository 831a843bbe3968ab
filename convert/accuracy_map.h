// The predicted accuracy of a compensated tool over a volume, for `accuracy-map`.
#pragma once

#include "absl/status/statusor.h"
#include "convert/run.h"
#include "truepose/v1/accuracy_map.pb.h"

namespace truepose::convert {

// @param spec faults have fields as `box.cone_rad`, `points`.
// @returns kInvalidArgument with faults of nominal, calibration and spec; kFailedPrecondition with
//   faults for a calibration without covariance, a verdict do_not_apply, a box of which nothing is
//   reached; kCancelled.
absl::StatusOr<v1::AccuracyMap> RunAccuracyMap(const v1::Nominal& nominal,
                                               const v1::Calibration& calibration,
                                               const v1::AccuracyMapSpec& spec,
                                               const RunHooks& hooks = {});

}  // namespace truepose::convert
