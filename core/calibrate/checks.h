// What must hold of a calibration problem and of its identification.
#pragma once

#include "core/calibrate/calibrate.h"
#include "core/calibrate/scope.h"

namespace truepose {

// kInvalidArgument: no reading, roles that do not match, no calibration row.
absl::Status CheckProblem(const CalibrationProblem& problem);

// kFailedPrecondition when there are not more measured values than parameters; a prior's count.
absl::Status CheckRedundancy(const Identification& identification);

// kFailedPrecondition with a fault for each parameter that other readings would determine.
absl::Status CheckComplete(const IdentifiableSet& set, const ParameterSet& candidates);

// kInvalidArgument: effects whose cause was not recorded (effect_choice.h, AvailableEffects).
absl::Status CheckEffects(const Robot& robot, const Problem& part,
                          const std::vector<EffectGroup>& groups);

// Weights without s_model (known_model_error 0, pose matching in joint space) exist where stated
// noise reaches every measured coordinate of every reading (StatedRank); where it does not,
// those coordinates would count as exact.
// kFailedPrecondition with a fault that names the joints, the coordinates and task_space.
absl::Status CheckJointSpace(const Robot& robot, const Problem& part, const Estimate& start,
                             const IdentifyOptions& options);

// kInvalidArgument: a stored calibration of another model.
absl::Status CheckConvention(const StoredCalibration& stored, const Model& model);

// kFailedPrecondition with a fault for each parameter that was asked for by name and can't be told
// by these readings.
absl::Status CheckNamed(const Scope& scope, const IdentifiableSet& set,
                        const ParameterSet& candidates);

}  // namespace truepose
