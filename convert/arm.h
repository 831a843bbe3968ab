// Nominal and calibration as the arm that compensation knows.
#pragma once

#include "absl/status/statusor.h"
#include "compensation/arm.h"
#include "convert/calibrated_model.h"
#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::convert {

struct CalibratedArm {
  CalibratedModel calibrated;
  compensation::Arm arm;
};

// What its own report says must not be applied reaches no robot, neither by targets nor in a table.
// @returns kFailedPrecondition with a fault of `calibration.report.verdict`, with all its reasons.
absl::Status CheckMayBeApplied(const v1::CalibrationReport& report);

// @returns the errors of RobotFrom, CalibratedModelFrom, CheckTorquesOfTargets and ArmFrom;
//   CheckMayBeApplied.
absl::StatusOr<CalibratedArm> CalibratedArmFrom(const v1::Nominal& nominal,
                                                const v1::Calibration& calibration);

}  // namespace truepose::convert
