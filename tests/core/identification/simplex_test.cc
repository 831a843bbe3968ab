// The search around the simplex: its limit, its start, and the other objective.
#include "core/identification/simplex.h"

#include <gtest/gtest.h>

#include "tests/core/testing/estimator_case.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using testing::EstimatorCase;

EstimatorCase SmallCase() {
  SimulateOptions options;
  options.poses = 30;
  const testing::Simulated simulated(testing::MeasuringArm(), testing::AnyTarget(), options);
  return EstimatorCase(simulated.robot(),
                       testing::ReadingsOf(simulated, ObservationKind::kPointAxis));
}

// Fewer evaluations than a simplex has vertices, too.
TEST(Simplex, LimitOfEvaluationsIsAnOutcomeWithTheBestSoFar) {
  const EstimatorCase c = SmallCase();
  for (int limit : {10, 200, 600}) {
    SolveOptions options;
    options.simplex.max_evaluations = limit;
    Estimate estimate = c.start();
    const SolveSummary summary =
        SearchBySimplex(c.problem(), c.model_error(), c.active(), options, {}, &estimate);
    EXPECT_EQ(summary.termination, Termination::kIterationLimit);
    EXPECT_LE(summary.evaluations, limit);
    EXPECT_LE(summary.final_cost, summary.initial_cost * (1 + 1e-12));
    const double cost =
        CostOf(c.problem(), estimate, WhitenersOf(c.problem(), c.start(), c.model_error()));
    EXPECT_NEAR(summary.final_cost / cost, 1, 1e-9);
  }
}

// At the minimum a restart finds nothing, and what was there is not lost.
TEST(Simplex, FromTheMinimumItStaysThere) {
  const EstimatorCase c = SmallCase();
  Estimate minimum;
  const double cost = c.SolveBy({}, &minimum).final_cost;
  const SolveSummary summary =
      SearchBySimplex(c.problem(), c.model_error(), c.active(), {}, {}, &minimum);
  EXPECT_EQ(summary.termination, Termination::kConverged);
  EXPECT_NEAR(summary.final_cost / cost, 1, 1e-3);
}

// Points only and the axis free: the target's turn has no effect on E_op, and must not run away.
TEST(Simplex, MeanPositionErrorLeavesWhatItDoesNotSee) {
  const EstimatorCase c = SmallCase();
  SolveOptions options;
  options.simplex.objective = SimplexObjective::kMeanPositionError;
  Estimate estimate = c.start();
  const SolveSummary summary =
      SearchBySimplex(c.problem(), c.model_error(), c.active(), options, {}, &estimate);
  EXPECT_EQ(summary.termination, Termination::kConverged) << summary.message;
  const Eigen::Matrix3d turn = estimate.X_FT[0].R.transpose() * c.start().X_FT[0].R;
  EXPECT_LT(LogRotation<double>(turn).norm(), 0.01);
}

TEST(Simplex, UndeterminedCandidatesAreAFailure) {
  const EstimatorCase c = SmallCase();
  std::vector<int> all(static_cast<size_t>(c.problem().CandidateCount()));
  for (size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  Estimate estimate = c.start();
  const SolveSummary summary =
      SearchBySimplex(c.problem(), c.model_error(), all, {}, {}, &estimate);
  EXPECT_EQ(summary.termination, Termination::kFailed);
  EXPECT_EQ(estimate.lambda, c.start().lambda);
}

}  // namespace
}  // namespace truepose
