// Options of a calibration as core takes them.
#pragma once

#include "absl/status/statusor.h"
#include "core/calibrate/calibrate.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::convert {

// @returns kInvalidArgument with every fault at once, fields `options.model` and so on: names that
// nobody knows, a prior without its calibration or the other way round, a covariance of the wrong
// size.
absl::StatusOr<CalibrateOptions> CalibrateOptionsFrom(const v1::CalibrationOptions& options);

}  // namespace truepose::convert
