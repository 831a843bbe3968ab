// Arms with errors that are known.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compensation/arm.h"
#include "core/models/model.h"
#include "core/robot/robot.h"

namespace truepose::testing {

// Errors of all internal parameters of the modified incremental model, drawn with these standard
// deviations.
compensation::Arm DrawnArm(const Robot& robot, uint64_t seed, double length_sd_m = 3e-4,
                           double angle_sd_rad = 3e-4);

// The robot with these limits on all revolute, and on all prismatic joints.
Robot WithLimits(const Robot& robot, double revolute, double prismatic);

// The four-joint SCARA of chapter-notes 1, RRPR.
Robot Scara();

}  // namespace truepose::testing
