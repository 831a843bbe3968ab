// Corrected joints by a table: at which the flange, as the table says that it stands, is where the
// nominal one would be.
//
// With E(q) the table's correction (table.h), joints q' are looked for at which
//   nominal chain with E(q') before Z_n  =  X_nominal(q),
// by Newton steps with the nominal Jacobian, E looked up again at every step. Six joints take one
// Jacobian and some steps; other arms go through SolveLeastSquares, once or twice for each
// lookup: with more joints the nearest solution, with fewer the least remainder in the coordinates
// that matter (ExactOptions).
#pragma once

#include "compensation/exact.h"
#include "compensation/lookup.h"
#include "compensation/outcome.h"

namespace truepose::compensation {

// What corrections are taken to, beside the rounding of lookups to float, 4e-7 of the correction: a
// thousandth of the tolerance that the table was asked for (20 nm of 0.02 mm), and no less than
// kLeastSolved. Verified errors of a table contain it.
inline constexpr double kSolvedShare = 1e-3;
inline constexpr double kLeastSolved = 1e-9;  // m, rad

// Outcomes:
//   kOk               q is corrected; position_error_m and rotation_error_rad are what is left by
//                     the table's E, or a bound of it, right to the rounding of E. How
//                     far E is from the identified chain is header.worst.
//   kOutsideDomain    of axis `joint`: the target is not in the domain, or the corrected joints not
//                     in its margin; the nominal joints are in q.
//   kNearSingular     the smallest singular value of the nominal Jacobian at the target is below
//                     header.smallest_singular_value, or, with fewer than six joints, joints would
//                     move by more than 100 times the error that they undo or do not settle
//                     (exact.h); the nominal joints are in q.
//   kBeyondLimit      q would be right but for the limit of controller joint `joint`.
//   kUnreachable      no joints were found; what is left is in the errors.
//   kInvalidArgument  a number that is not finite, or a measuring arm.
// smallest_singular_value, at the target, is given with kNearSingular and when a correction was not
// found the fast way; else -1.
// @param q_controller  the target's joints, header.joints numbers, rad or m
Correction CorrectByTable(const Table& table, const double* q_controller) noexcept;

// Where the tip of an arm is whose joints were read, by the table: X_BF X_FT with
// X_BF = X_BL E Z_n C[n]. Of any arm, measuring or not, near singularities too.
// @returns outcome kOk, kOutsideDomain or kInvalidArgument; a pose only with kOk.
Tip TipByTable(const Table& table, const double* q_controller, const Pose& X_FT,
               const Eigen::Vector3d& axis_T) noexcept;

}  // namespace truepose::compensation
