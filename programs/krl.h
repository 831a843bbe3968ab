// Joint targets of KRL (KUKA Robot Language), degrees, and mm of axes that slide.
//
// Targets are aggregates that give numbers to A1, A2, ... An without a gap, in any order:
//   PTP {A1 0,A2 -90,...}, SPTP {...}, also {E6AXIS: A1 0,...}
//   DECL E6AXIS XP1={A1 0,...} and AXIS, with DECL, GLOBAL, CONST or without (declared in .dat
//   files) XP1={A1 0,...}, XP[3]={A1 0,...}
// External axes E1 to E6 stay. A variable of which the text also uses single axes, or that it moves
// to relatively, copies or hands on, stays and is listed. So are poses (POS, E6POS, FRAME),
// relative motions, system variables ($...), aggregates that leave out an axis (which then stays
// where it is at run time) and all that is calculated. Lines that begin with & and comments, folds
// among them, are not read.
#pragma once

#include <string_view>

#include "programs/program.h"

namespace truepose::programs {

// @param joints of the robot. Fewer axes than that leave one out, unless they are A1 to A6 at
// least; the caller finds a wrong number.
Program ReadKrl(std::string_view text, int joints);

}  // namespace truepose::programs
