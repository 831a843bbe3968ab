// Eq. 10 repeated: where it ends, and that what is no minimum is not called one.
#include "core/identification/linear_iteration.h"

#include <gtest/gtest.h>

#include "core/identification/prediction.h"
#include "tests/core/testing/estimator_case.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using testing::EstimatorCase;

EstimatorCase SmallCase() {
  SimulateOptions options;
  options.poses = 30;
  const testing::Simulated simulated(testing::Ur10(), testing::AnyTarget(), options);
  return EstimatorCase(simulated.robot(), testing::ReadingsOf(simulated, ObservationKind::kPose));
}

// A further solve from the end finds nothing: the minimum stands.
TEST(LinearIteration, EndsInAStableMinimum) {
  const EstimatorCase c = SmallCase();
  Estimate estimate = c.start();
  const SolveSummary first =
      IterateLinearly(c.problem(), c.model_error(), c.active(), {}, {}, &estimate);
  EXPECT_EQ(first.termination, Termination::kConverged);
  EXPECT_LE(first.iterations, 8) << "second order but for the residuals";
  const SolveSummary second =
      IterateLinearly(c.problem(), c.model_error(), c.active(), {}, {}, &estimate);
  EXPECT_EQ(second.iterations, 1);
  EXPECT_NEAR(second.final_cost / first.final_cost, 1, 1e-12);
}

// One iteration is the chapter's linear solution; it says that it has not converged, and is kept.
TEST(LinearIteration, LimitIsNotConvergence) {
  const EstimatorCase c = SmallCase();
  SolveOptions options;
  options.max_iterations = 1;
  Estimate estimate = c.start();
  const SolveSummary summary =
      IterateLinearly(c.problem(), c.model_error(), c.active(), options, {}, &estimate);
  EXPECT_EQ(summary.termination, Termination::kIterationLimit);
  EXPECT_LT(summary.final_cost, summary.initial_cost / 10);
  EXPECT_NEAR(CostOf(c.problem(), estimate, WhitenersOf(c.problem(), c.start(), c.model_error())),
              summary.final_cost, 1e-9 * summary.final_cost);
}

// Residuals of zero: no share of the cost is small, so the step must end it.
TEST(LinearIteration, ExactReadingsConverge) {
  const EstimatorCase c = SmallCase();
  Problem exact = c.problem();
  Estimate truth = c.start();
  truth.lambda = Eigen::VectorXd::Constant(truth.lambda.size(), 1e-4);
  for (Reading& reading : exact.readings) reading.X_MT = Predict(exact, reading, truth);
  Estimate estimate = c.start();
  const SolveSummary summary = IterateLinearly(exact, {1e-7, 1e-8}, c.active(), {}, {}, &estimate);
  EXPECT_EQ(summary.termination, Termination::kConverged) << summary.message;
  EXPECT_LT(summary.final_cost, 1e-6);
}

// Frames half a turn off: the first undamped steps throw the estimate away. Levenberg and Marquardt
// would refuse such a step; here it must not pass for a result.
TEST(LinearIteration, DivergenceIsAFailureThatLeavesTheEstimate) {
  const EstimatorCase c = SmallCase();
  int diverged = 0;
  for (double turn : {1.5, 2.0, 2.5, 3.0}) {
    Estimate start = c.start();
    start.X_MB[0].R = ExpRotation<double>({0, turn, 0}) * start.X_MB[0].R;
    start.X_FT[0].R = start.X_FT[0].R * ExpRotation<double>({turn, 0, 0});
    Estimate estimate = start;
    const SolveSummary summary =
        IterateLinearly(c.problem(), c.model_error(), c.active(), {}, {}, &estimate);
    if (summary.termination != Termination::kFailed) continue;
    ++diverged;
    EXPECT_NE(summary.message.find("diverged"), std::string::npos) << summary.message;
    EXPECT_EQ(estimate.lambda, start.lambda);
    EXPECT_EQ(estimate.X_MB[0].R, start.X_MB[0].R);
  }
  EXPECT_GT(diverged, 0);
}

// dq1 acts as a turn of the base about z: with both active there is no one step.
TEST(LinearIteration, UndeterminedCandidatesAreAFailure) {
  const EstimatorCase c = SmallCase();
  std::vector<int> active = c.active();
  active.push_back(c.problem().FirstInternal() + *c.problem().model->parameters.Find("dq1"));
  std::sort(active.begin(), active.end());
  ASSERT_EQ(std::adjacent_find(active.begin(), active.end()), active.end());
  Estimate estimate = c.start();
  const SolveSummary summary =
      IterateLinearly(c.problem(), c.model_error(), active, {}, {}, &estimate);
  EXPECT_EQ(summary.termination, Termination::kFailed);
  EXPECT_NE(summary.message.find("determine"), std::string::npos) << summary.message;
  EXPECT_EQ(estimate.lambda, c.start().lambda);
}

}  // namespace
}  // namespace truepose
