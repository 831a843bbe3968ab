// What a fixture's own errors do to a calibration.
//
// A socket that was measured 0.1 mm off is off by the same 0.1 mm at each contact with it, in every
// placement: the error does not average out. In the weights a contact's stated covariance S stands
// as if it were the contact's own (weights.h), which weighs features by how well they are known. In
// the covariance of the parameters it is what it is, one error a feature f:
//   C_common = C (sum_f B_f B_f') C,   B_f = sum_h in f J_h' R_h^-1 D_h L,   S = L L'
// C: the covariance of the parameters, (J'R^-1 J)^-1; D: residual by pose (measurement/reading.h).
// C itself keeps S as noise: too large by S over the number of contacts, which is on the safe side.
#pragma once

#include "core/identification/weights.h"

namespace truepose {

// C_common of the active candidates, SI. Contacts at one place of M are with one feature; those
// without a stated covariance add nothing.
// @param system of the problem's readings at the estimate. @param C of `active`, as they stand.
// @returns active x active; empty when no contact has a covariance or C is empty.
Eigen::MatrixXd FixtureCovariance(const Problem& problem, const Estimate& estimate,
                                  const ModelError& model_error, const WhitenedSystem& system,
                                  const std::vector<int>& active, const Eigen::MatrixXd& C);

}  // namespace truepose
