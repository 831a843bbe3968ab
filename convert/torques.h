// Compliance needs a torque wherever it is used: measured with the reading, or of gravity on the
// masses of the robot file. Where neither is there it would count as nothing, in silence.
#pragma once

#include <string>
#include <vector>

#include "absl/status/status.h"
#include "convert/calibrated_model.h"
#include "core/calibrate/calibrate.h"

namespace truepose::convert {

// Whether the model has compliance and no masses to reckon torques from.
bool NeedsMeasuredTorques(const Model& model);

// Targets bring no torques. @returns kInvalidArgument with a fault when the calibration's
// compliance needs them; OK where none was identified.
absl::Status CheckTorquesOfTargets(const CalibratedModel& calibrated);

// @returns kInvalidArgument with a fault that counts the readings without torques when the
// calibration's compliance needs them.
absl::Status CheckTorquesOfReadings(const CalibratedModel& calibrated,
                                    const std::vector<Reading>& readings);

// What a report says of compliance that only readings with torques can use; "" where that is not
// so.
std::string TorqueWarning(const Model& model);

}  // namespace truepose::convert
