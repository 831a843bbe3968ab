// Joint targets of URScript (Universal Robots), rad.
//
// Targets are lists of numbers, d2r(number) included, where a motion takes joints:
//   movej movel movep servoj servoc: the first argument, also by its name (q=, pose=)
//   movec: the first two
// and lists given to a variable of which every use is such an argument. Poses p[...] are Cartesian:
// the controller finds the joints for them by its own kinematics, so that they stay and are listed;
// so is every other argument that is no plain list, and every list of six numbers or more that
// stands elsewhere: in a call of another function, or in a list of lists. What stands in calls of
// set_... (tool, payload), speedj, speedl, force_mode, direct_torque, path_offset_set and
// wrench_trans is no target.
#pragma once

#include <string_view>

#include "programs/program.h"

namespace truepose::programs {

Program ReadUrScript(std::string_view text);

}  // namespace truepose::programs
