// Whole turns of joints that leave the pose as it is.
#pragma once

#include "compensation/arm.h"

namespace truepose::compensation {

// Whether a whole turn of a controller joint turns revolute chain joints by whole turns and moves
// no prismatic one.
bool WholeTurnIsNoMotion(const Arm& arm, int joint) noexcept;

// Brings each such joint to within half a turn of the reference, and where that is beyond a limit
// to the turn nearest to the reference that is within, if there is one.
// @returns the first joint that stays beyond its limits, or -1.
int Unwind(const Arm& arm, const double* q_reference, double* q) noexcept;

// Whole turns of revolute *chain* joints: to within half a turn of the reference.
void UnwindChain(const JointChain& chain, const double* q_reference, double* q_chain) noexcept;

}  // namespace truepose::compensation
