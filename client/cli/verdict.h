// What a person is told when a calibration is about to be applied.
#pragma once

#include "client/cli/console.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::cli {

// A warning on console.err when the verdict is "apply within volume". "Do not apply" needs none:
// the compensation itself refuses it.
void WarnOfVerdict(const Console& console, const v1::CalibrationReport& report);

}  // namespace truepose::cli
