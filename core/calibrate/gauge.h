// Where B and F stand when joints have effects.
//
// A constant shift of joint 1 is a motion of the base, one of the last joint a motion of the tool:
// the readings can't tell them, and without effects dq1 = dq_n = 0 settles it (architecture: B at
// the nominal zero of joint 1, F at that of the last). Harmonics and gain of these joints have
// means of their own over the measured joints; left as they are, base and tool would carry them and
// compensation would turn the robot by them. So dq1 and dq_n are set to minus those means: effects
// move joints 1 and n by nothing on average.
#pragma once

#include "core/identification/identify.h"

namespace truepose {

// Moves the means of joints 1 and n from base and tool frames into dq1 and dq_n. Predictions stay.
// Models without dq, and joints whose dq was identified, stay as they are.
// @param problem its readings are those averaged over.
void CentreEffects(const Problem& problem, const std::vector<int>& active, Estimate* estimate);

}  // namespace truepose
