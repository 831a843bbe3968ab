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

// @returns the errors of RobotFrom, CalibratedModelFrom, CheckTorquesOfTargets and ArmFrom;
//   kFailedPrecondition with a fault of `calibration.report.verdict` for do_not_apply.
absl::StatusOr<CalibratedArm> CalibratedArmFrom(const v1::Nominal& nominal,
                                                const v1::Calibration& calibration);

}  // namespace truepose::convert
