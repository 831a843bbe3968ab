// What a drift check says, in sentences with their figures.
#pragma once

#include <string>
#include <vector>

#include "core/drift/drift_problem.h"
#include "core/drift/drift_tests.h"

namespace truepose {

// @param result complete but for its findings. @param more all parts together explain more than the
// likeliest one does.
std::vector<std::string> FindingsOf(const DriftCheckResult& result, const DriftSums& sums,
                                    bool more);

}  // namespace truepose
