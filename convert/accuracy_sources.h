// What a stored calibration says of the accuracy that it leaves.
#pragma once

#include <optional>

#include "convert/calibrated_model.h"
#include "core/compensation/tool_accuracy.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::convert {

// Nothing where the calibration has no covariance, as of a list, an event or a simulated truth.
// @param calibrated is pointed to by the result.
std::optional<AccuracySources> AccuracySourcesFrom(const CalibratedModel& calibrated,
                                                   const v1::Calibration& calibration);

}  // namespace truepose::convert
