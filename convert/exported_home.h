// What every export begins with: the home geometry of a nominal with or without a calibration.
#pragma once

#include "absl/status/statusor.h"
#include "core/export/home.h"
#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::convert {

// @param calibration may be nullptr. Errors as in export.h.
absl::StatusOr<Home> ExportedHome(const v1::Nominal& nominal, const v1::Calibration* calibration,
                                  JointSense sense);

// A chain of the form of formats/joint_origins.h: the constants of each pose, each followed by its
// joint, the last one by none.
v1::Geometry GeometryOf(const Home& home, const std::vector<Pose>& frames);

}  // namespace truepose::convert
