// Weighted nonlinear least squares by Levenberg-Marquardt, with analytic Jacobians.
#pragma once

#include "core/identification/solve.h"

namespace truepose {

// Solve() by Levenberg-Marquardt, whatever the options' estimator.
SolveSummary Minimise(const Problem& problem, const ModelError& model_error,
                      const std::vector<int>& active, const SolveOptions& options,
                      const Hooks& hooks, Estimate* estimate);

}  // namespace truepose
