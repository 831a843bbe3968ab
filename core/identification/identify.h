// Identification with weights that fit the residuals: the loop around the solver.
//
//   start -> frames alone ("before") -> identifiable set -> { solve, estimate s_model } until
//   s_model stands -> identifiable set again with the right weights; solve again if it changed ->
//   covariance
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/identification/identifiability.h"
#include "core/identification/solve.h"
#include "core/identification/start_values.h"

namespace truepose {

struct Identification {
  Estimate estimate;
  ModelError model_error;
  IdentifiableSet set;         // redundancies marked structural where they hold for any poses
  Eigen::MatrixXd covariance;  // of set.active, in their order; SI
  SolveSummary summary;        // of the whole loop: first cost, last cost, iterations summed
  int rows = 0;
  double weighted_residual_variance = 0;  // 2 cost / (rows - active): 1 where the weights settled
};

struct IdentifyOptions {
  SolveOptions solve;
  IdentifiabilityOptions identifiability;
  // Relative change of s_model that ends the loop; 1e-5 of s_model moves parameters by far less
  // than their deviation.
  double weight_tolerance = 1e-5;
  int max_weight_rounds = 30;
};

// Fits base and tool alone, lambda as given: "before", and how a calibration meets a new session.
// @param start frames near the minimum (FindStart). @returns kCancelled; not converging is in the
// summary.
absl::StatusOr<Identification> FitFrames(const Problem& problem, const Estimate& start,
                                         const IdentifyOptions& options, const Hooks& hooks);

// @returns kFailedPrecondition with a fault for each base or tool direction that generic readings
// would
//   determine (`generic`) and `actual` does not have.
absl::Status CheckFrames(const Problem& problem, const IdentifiableSet& generic,
                         const IdentifiableSet& actual);

// Identifies everything that the readings determine, from `before` = FitFrames at nominal lambda.
// @param generic GenericIdentifiable of the problem: what could be determined at best.
// @returns kFailedPrecondition with a fault for each base or tool direction that generic readings
// would determine and
//   these do not; kCancelled. Not converging is an outcome in the summary.
absl::StatusOr<Identification> Identify(const Problem& problem, const IdentifiableSet& generic,
                                        const Identification& before,
                                        const IdentifyOptions& options, const Hooks& hooks);

}  // namespace truepose
