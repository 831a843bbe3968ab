// The peer: Ceres with automatic differentiation and DENSE_QR on the same problem.
#pragma once

#include <vector>

#include "bench/shared_problem.h"

namespace truepose::bench {

// All parameters after the fit, the ones that are not free at nominal.
std::vector<double> AutodiffSolve(const SharedProblem& problem);

// Position of T in M at q, m.
std::array<double, 3> TipOf(const std::vector<double>& parameters, const std::vector<double>& q);

}  // namespace truepose::bench
