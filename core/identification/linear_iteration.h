// The chapter's linear iteration, Eq. 10: A_h dLambda = b_h, all readings stacked and solved by
// least squares, again and again. From the second iteration on both A_h and b_h are those of the
// current Lambda_j (chapter-notes 16). Weighted, that is Gauss and Newton's iteration without
// damping.
//
// It ends
//   converged        when the linear problem promises a decrease of less than 1e-12 of the cost, or
//                    of less than 1e-7 of a standard deviation's square: a minimum that stands;
//   iteration_limit  after options.max_iterations. The result is the least cost that was seen, as
//                    steps that are not damped may circle the minimum;
//   failed           "diverged" when a step raises the cost to more than 10 times the least so far
//                    (the iteration may overshoot once and come back, but not from there); also
//                    when the readings do not determine the active candidates, or a residual is not
//                    finite. The estimate is left as it was.
#pragma once

#include "core/identification/solve.h"

namespace truepose {

// Solve() by linear iteration, whatever the options' estimator.
SolveSummary IterateLinearly(const Problem& problem, const ModelError& model_error,
                             const std::vector<int>& active, const SolveOptions& options,
                             const Hooks& hooks, Estimate* estimate);

}  // namespace truepose
