// The chapter's amoeba on the weighted problem: Nelder and Mead's simplex (nelder_mead.h).
//
// Parameters as they come are so unlike in effect and so correlated that the simplex stalls. It
// moves in decorrelated coordinates y, x = x0 + D V S^-1 y, with U S V' the singular values of J D,
// J the whitened Jacobian at x0 and D scaling its columns to norm 1: there the cost is
// 1/2 |U'r + y|^2 + a constant as far as the problem is linear. Coordinates and simplex are made
// anew at each restart, from the best point so far, until a restart no longer improves.
//
// It ends
//   converged        a restart improved the objective by less than 1e-5 of it;
//   iteration_limit  after options.simplex.max_evaluations; the result is the best point so far;
//   failed           a residual at the start is not finite, or the readings do not determine the
//                    active candidates. The estimate is left as it was.
//
// With the mean position error (E_op of the chapter) as objective it solves another problem:
// rotations and the prior have no part in it, and it determines fewer parameters (23 of 25 of the
// measuring robot). J is then that of the positions, and directions that they do not see stay as
// they are. Its weighted cost is above the minimum; costs in the summary are the weighted ones all
// the same.
#pragma once

#include "core/identification/solve.h"

namespace truepose {

// Solve() by the simplex, whatever the options' estimator. Of the options only `simplex` counts.
SolveSummary SearchBySimplex(const Problem& problem, const ModelError& model_error,
                             const std::vector<int>& active, const SolveOptions& options,
                             const Hooks& hooks, Estimate* estimate);

}  // namespace truepose
