// Identification with weights that fit the residuals: the loop around the solver.
//
//   start -> frames alone ("before") -> identifiable set -> { solve, estimate s_model, weigh the
//   readings } until all stand -> identifiable set again with the right weights; solve again if it
//   changed -> covariance
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/identification/identifiability.h"
#include "core/identification/robust.h"
#include "core/identification/solve.h"
#include "core/identification/start_values.h"

namespace truepose {

// Of weights whose scale is not sure: the covariance was multiplied by `value`, the weighted
// residual variance, and R is to be multiplied by it wherever both are used.
struct VarianceFactor {
  double value = 1;
  ModelError unexplained;  // root of the readings' mean variance of R times the factor, per axis
};

struct Identification {
  Estimate estimate;
  ModelError model_error;
  IdentifiableSet set;         // redundancies marked structural where they hold for any poses
  Eigen::MatrixXd covariance;  // of set.active, in their order; SI
  // What of the covariance comes from a fixture's own errors (fixture_error.h), which more contacts
  // do not lessen; empty without.
  Eigen::MatrixXd fixture_covariance;
  // Of the whole loop: first cost, last cost, iterations and evaluations summed over the rounds of
  // weights. An estimator that runs once, on the weights found: those of its one run.
  SolveSummary summary;
  std::vector<double> weights;  // of the readings; all 1 without a robust loss
  int rows = 0;                 // measured values; those of a prior are not among them
  // Sum of (w d)^2 / [k (sum of w - active)] over rows of residual d standard deviations, with the
  // weights w of a robust loss and its consistency k (robust.h): 1 where the weights settled.
  // Without a loss w = k = 1, 2 cost / (rows - active). Rows of a prior are among them.
  double weighted_residual_variance = 0;
  std::optional<VarianceFactor> variance_factor;  // with IdentifyOptions::scale_covariance
};

struct IdentifyOptions {
  SolveOptions solve;
  IdentifiabilityOptions identifiability;
  // Relative change of s_model that ends the loop; 1e-5 of s_model moves parameters by far less
  // than their deviation.
  double weight_tolerance = 1e-5;
  int max_weight_rounds = 30;
  Loss loss = Loss::kNone;
  // Candidates that may move; empty = all. The others stay where the start has them.
  std::vector<int> free;
  // Where coordinates of targets stay that nothing tells from motions of the base (frame_gauge.h).
  Pose X_FT_nominal;
  // s_model of an earlier calibration in place of an estimate, for readings too few to give one.
  std::optional<ModelError> known_model_error;
  // Multiplies the covariance by the weighted residual variance, the variance factor: for weights
  // whose scale is not sure, as with known_model_error = 0.
  bool scale_covariance = false;
};

// Fits base and tool alone, lambda as given: "before", and how a calibration meets a new session.
// Which of their coordinates the readings determine is judged at nominal lambda; the others of the
// targets go to options.X_FT_nominal.
// @param start frames near the minimum (FindStart). @returns kCancelled; not converging is in the
// summary.
absl::StatusOr<Identification> FitFrames(const Problem& problem, const Estimate& start,
                                         const IdentifyOptions& options, const Hooks& hooks);

// Whether a tool direction that was dropped acts as motions of base (and other directions of tool)
// alone: where only parallel joints move, a shift of the target along them is one of the base. The
// robot does not depend on it, so the direction stays where it started and the base takes it up.
// False below three readings, and where the readings show no direction of that tool at all: then
// the arm did not move.
bool IsTakenUpByFrames(const Problem& problem, const IdentifiableSet& actual,
                       const NullRelation& relation);

// @returns kFailedPrecondition with a fault for each base or tool direction that generic readings
// would determine (`generic`) and `actual` does not have, but those that IsTakenUpByFrames.
absl::Status CheckFrames(const Problem& problem, const IdentifiableSet& generic,
                         const IdentifiableSet& actual);

// The set with which Identify begins, without solving: what the readings determine at nominal
// lambda, redundancies marked structural. None is called too weak yet: that needs the residuals.
// @returns kFailedPrecondition as Identify does.
absl::StatusOr<IdentifiableSet> IdentifiableAtStart(const Problem& problem,
                                                    const IdentifiableSet& generic,
                                                    const Identification& before,
                                                    const IdentifyOptions& options);

// Identifies everything that the readings determine, from `before` = FitFrames at nominal lambda,
// or at that of an earlier calibration. The problem's prior takes part; which parameters are
// identifiable is judged without it, at nominal lambda, and with it none is called too weak.
// @param generic GenericIdentifiable of the problem: what could be determined at best.
// @returns kFailedPrecondition as CheckFrames; kCancelled. Not converging is an outcome in the
// summary.
absl::StatusOr<Identification> Identify(const Problem& problem, const IdentifiableSet& generic,
                                        const Identification& before,
                                        const IdentifyOptions& options, const Hooks& hooks);

// The covariance without the fixture's share: what the scatter of the readings alone leaves.
Eigen::MatrixXd ScatterCovariance(const Identification& identification);

// What the parameters leave unexplained: s_model, or that of the variance factor.
ModelError UnexplainedOf(const Identification& identification);

// (J'J)^-1 of the active columns, by QR of the columns scaled to norm 1. @param J rows >= active.
Eigen::MatrixXd ParameterCovariance(const Eigen::MatrixXd& J, const std::vector<int>& active);

}  // namespace truepose
