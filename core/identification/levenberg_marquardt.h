// Weighted nonlinear least squares by Levenberg-Marquardt, with analytic Jacobians.
#pragma once

#include <string>

#include "core/base/hooks.h"
#include "core/identification/problem.h"
#include "core/identification/weights.h"

namespace truepose {

enum class Termination { kConverged, kIterationLimit, kCancelled, kFailed };

const char* Name(Termination termination);

struct SolveOptions {
  int max_iterations = 100;
  // Relative decrease of the cost that counts as converged. 1e-14 is near the last bit of the sum,
  // so that two ways to the same minimum agree in their parameters to about 1e-7 of a standard
  // deviation.
  double function_tolerance = 1e-14;
  double parameter_tolerance = 1e-14;  // relative step
};

struct SolveSummary {
  Termination termination = Termination::kFailed;
  int iterations = 0;
  double initial_cost = 0;  // half the weighted sum of squares
  double final_cost = 0;
  std::string message;
};

// Minimises 1/2 sum |r_i / sd_i|^2 over the active candidates, the others keep their value.
// @param estimate start on entry, the minimum on return; on kCancelled and kFailed it is left as it
// was.
SolveSummary Minimise(const Problem& problem, const ModelError& model_error,
                      const std::vector<int>& active, const SolveOptions& options,
                      const Hooks& hooks, Estimate* estimate);

}  // namespace truepose
