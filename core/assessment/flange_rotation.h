// How well the orientation of the flange is known: readings of points may leave it open although
// their own errors are small, and compensation would then turn the tool by what is not known.
#pragma once

#include "core/assessment/verdict.h"
#include "core/identification/identify.h"

namespace truepose {

// RMS over the readings' joints of the deviation of the flange's orientation in B, rad: the square
// root of the trace of J_w C J_w', with J_w the rotational rows of the parameters' Jacobian (Eq.
// 31) and C the covariance of the internal parameters that were identified. 0 without readings or
// covariance.
double FlangeRotationSd(const Problem& problem, const Identification& identification);

// apply becomes apply_within_volume when that deviation exceeds 0.5 deg, as much as may stay
// unexplained.
void JudgeFlangeRotation(double rotation_sd_rad, Verdict* verdict);

}  // namespace truepose
