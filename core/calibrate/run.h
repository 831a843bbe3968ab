// What Calibrate and PreviewCalibration have in common: model, prior, scope, and base and tool
// fitted at nominal lambda. Only for .cc files of this folder.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/calibrate/calibrate.h"
#include "core/calibrate/scope.h"
#include "core/calibrate/sets.h"
#include "core/calibrate/staged_hooks.h"

namespace truepose {

// What the whole run shares; refers to the caller's problem, options and hooks.
struct CalibrationRun {
  const CalibrationProblem& problem;
  const CalibrateOptions& options;
  StagedHooks stages;
  Part part;
  IdentifyOptions identify;
  Scope scope;
  Eigen::VectorXd start_lambda;  // nominal, or that of the stored calibration
};

// Effects that are named in the options; none when they are chosen by the readings.
std::vector<EffectGroup> ListedEffects(const CalibrateOptions& options);
absl::StatusOr<Model> ModelOf(const CalibrationProblem& problem, const CalibrateOptions& options,
                              const std::vector<EffectGroup>& effects);
// Whether what is not to be found anew stays as the stored calibration has it.
bool HoldsTheRest(const CalibrateOptions& options);
// The prior, the scope and what a stored calibration gives, for the run's model.
// @returns kInvalidArgument with faults of `options.calibrate` and `options.prior_calibration`.
absl::Status Prepare(const Model& model, CalibrationRun* run);
// Start values, then base and tool alone on the calibration rows: stages up to 0.3 of the run.
// @returns kFailedPrecondition or kInvalidArgument with faults when there is no start; kCancelled.
absl::Status FindBefore(CalibrationRun* run, Identification* before);

}  // namespace truepose
