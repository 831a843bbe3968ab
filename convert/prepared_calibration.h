// A calibration's input as core takes it: what a run and its preview have in common.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "convert/readings.h"
#include "convert/run.h"
#include "core/base/hooks.h"
#include "core/calibrate/calibrate.h"

namespace truepose::convert {

struct PreparedCalibration {
  std::unique_ptr<const Robot> robot;             // that readings.problem points to
  std::vector<const v1::SessionInput*> sessions;  // of the input, which outlives this
  ReadingsProblem readings;
  CalibrateOptions options;
  std::vector<std::string> warnings;  // the hints, and of joints beyond their limits
  std::vector<std::string> hints;     // at units that may be others than the columns say
};

// @returns kInvalidArgument with the faults of options, nominal, readings and, with strict_limits,
// of limits.
absl::StatusOr<PreparedCalibration> PrepareCalibration(const v1::CalibrationInput& input);

// Progress as messages.
Hooks CoreHooks(const RunHooks& hooks);

}  // namespace truepose::convert
