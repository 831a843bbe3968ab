// What a person is told when a calibration is about to be applied.
#pragma once

#include "absl/status/status.h"
#include "client/cli/console.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::cli {

// A warning on console.err when the verdict is "apply within volume". "Do not apply" needs none:
// the compensation itself refuses it.
void WarnOfVerdict(const Console& console, const v1::CalibrationReport& report);

// A refusal of a calibration because of its verdict "do not apply" is a fault of the input, exit
// code 3, whoever found it; any other status stays as it is.
absl::Status AsFaultOfVerdict(const absl::Status& status);

}  // namespace truepose::cli
