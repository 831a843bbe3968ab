// How far apart two calibrations of a robot put its flange.
#pragma once

#include "absl/status/statusor.h"
#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::convert {

// The largest distance, in mm, between the flange positions of the two calibrations over 500
// configurations drawn from the robot's joint limits (+-180 deg or +-0.5 m where there is none),
// always the same ones. Both are of `nominal`; a calibration without internal parameters is the
// nominal robot.
// @returns the faults of a nominal or calibration that don't fit together.
absl::StatusOr<double> FlangeChangeMm(const v1::Nominal& nominal, const v1::Calibration& a,
                                      const v1::Calibration& b);

}  // namespace truepose::convert
