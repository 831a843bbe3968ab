// Joint targets of RAPID (ABB), degrees, and mm of axes that slide.
//
// Targets are [[rax_1..rax_6],[eax_a..eax_f]] of numbers
//   in MoveAbsJ and its kin (MoveAbsJDO, MoveAbsJAO, MoveAbsJGO, MoveAbsJSync, TriggAbsJ)
//   given to a variable that this text declares as jointtarget: CONST, PERS, VAR, LOCAL, TASK,
//   arrays of one to three dimensions, and later assignments.
// A robot axis of 9E9 is one that the robot does not have; external axes stay. A variable that the
// text also takes apart, calculates with or hands on stays and is listed; so are robtargets and
// motions to them, which are Cartesian, and all that is calculated.
#pragma once

#include <string_view>

#include "programs/program.h"

namespace truepose::programs {

Program ReadRapid(std::string_view text);

}  // namespace truepose::programs
