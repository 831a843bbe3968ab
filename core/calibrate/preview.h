// What a calibration would identify, without solving for it.
#pragma once

#include "absl/status/statusor.h"
#include "core/calibrate/calibrate.h"

namespace truepose {

struct CalibrationPreview {
  Model model;
  ParameterSet candidates;  // of the set
  // Where Calibrate begins: what the calibration rows determine at nominal lambda, redundancies
  // marked structural. A run may drop more, parameters that prove too weak for the residuals that
  // it finds, or that a selection leaves out, and may add effects that it chooses: those need the
  // solution.
  IdentifiableSet set;
  ParameterCounts counts;
  int generic_rank = 0;  // what readings of this sort could determine at any poses
};

// Fits base and tool alone, at nominal lambda or that of a stored calibration, then looks at the
// Jacobian of the calibration rows (identification/identifiability.h).
// @returns the errors of Calibrate up to its first identification, and with require_complete its
// fault for each dependent direction. kCancelled.
absl::StatusOr<CalibrationPreview> PreviewCalibration(const CalibrationProblem& problem,
                                                      const CalibrateOptions& options,
                                                      const Hooks& hooks);

}  // namespace truepose
