// Two parts that have changed together: a bump moves the base and turns a joint.
//
// Asked only where no single part explains what has changed. Two parts are named when
//   - what all parts together explain beyond them is not significant at 0.001;
//   - what they explain beyond the better one of them is significant at 0.01 among all pairs
//     (Bonferroni);
//   - the pair's BIC is the least by at least 2.
#pragma once

#include <optional>
#include <vector>

#include "core/drift/drift_parts.h"
#include "core/drift/drift_tests.h"

namespace truepose {

// What is known of single parts.
struct SingleFits {
  Freedom legitimate;
  DriftFit none, all;  // nothing, and everything, may change
  std::vector<CandidatePart> parts;
  std::vector<DriftFit> of_parts;  // one a part
  DriftSums sums;
};

// @returns both parts in the order of `parts`, each with its change, nothing else filled in; none
// where no pair is to be named.
std::optional<std::vector<DriftPart>> ChangedTogether(const DriftProblem& problem,
                                                      const DriftFitter& fitter,
                                                      const SingleFits& fits);

}  // namespace truepose
