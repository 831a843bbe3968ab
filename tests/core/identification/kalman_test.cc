// The filter against the batch that it must equal, and against the mistakes that filters make.
#include "core/identification/kalman.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/core/testing/estimator_case.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using testing::EstimatorCase;

EstimatorCase SmallCase() {
  SimulateOptions options;
  options.poses = 40;
  const testing::Simulated simulated(testing::Ur10(), testing::AnyTarget(), options);
  return EstimatorCase(simulated.robot(), testing::ReadingsOf(simulated, ObservationKind::kPose));
}

Eigen::MatrixXd DefaultP0(const EstimatorCase& c) {
  return InitialCovariance(c.problem(), c.active(), {});
}

// The normal equations of all readings at once, scaled: (P_0^-1 + J'J) x = P_0^-1 x_0 + J'(J x_0 -
// r).
struct Batch {
  Eigen::VectorXd x;
  Eigen::MatrixXd P;
};

Batch SolveBatch(const WeightedProblem& problem, const Eigen::VectorXd& linear_at,
                 const Eigen::MatrixXd& P_0) {
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
  problem.Linearise(linear_at, &r, &J);
  const Eigen::VectorXd s = P_0.diagonal().cwiseSqrt();
  const Eigen::MatrixXd Js = J * s.asDiagonal();
  const Eigen::MatrixXd A = Eigen::MatrixXd::Identity(s.size(), s.size()) + Js.transpose() * Js;
  const Eigen::VectorXd b = problem.Start().cwiseQuotient(s) + Js.transpose() * (J * linear_at - r);
  return {s.asDiagonal() * A.ldlt().solve(b), s.asDiagonal() * A.inverse() * s.asDiagonal()};
}

void ExpectEqual(const KalmanFilter& filter, const Batch& batch) {
  const Eigen::VectorXd sd = batch.P.diagonal().cwiseSqrt();
  const Eigen::MatrixXd P = filter.covariance();
  for (Eigen::Index i = 0; i < sd.size(); ++i) {
    EXPECT_NEAR(filter.state()(i), batch.x(i), 1e-6 * sd(i)) << i;
    for (Eigen::Index j = 0; j < sd.size(); ++j)
      EXPECT_NEAR(P(i, j), batch.P(i, j), 1e-6 * sd(i) * sd(j)) << i << " " << j;
  }
}

// Linearised at one place, one at a time is the batch, in any order. 1e-6 of a deviation: the batch
// squares the condition.
TEST(Kalman, OneAtATimeEqualsTheBatch) {
  const EstimatorCase c = SmallCase();
  const WeightedProblem weighted(c.problem(), c.model_error(), c.active(), c.start());
  const Eigen::VectorXd at = weighted.Start().array() + 1e-4;
  const Batch batch = SolveBatch(weighted, at, DefaultP0(c));
  for (bool backwards : {false, true}) {
    KalmanFilter filter(c.problem(), c.active(), c.start(), DefaultP0(c));
    filter.LineariseAt(at);
    const size_t count = c.problem().readings.size();
    for (size_t i = 0; i < count; ++i) {
      const size_t k = backwards ? count - 1 - i : i;
      filter.Update(c.problem().readings[k], weighted.whiteners()[k]);
    }
    ExpectEqual(filter, batch);
  }
}

// The problem's prior is in the filter before the first reading, as in the batch.
TEST(Kalman, PriorOfTheProblemIsInitialInformation) {
  const EstimatorCase c = SmallCase();
  Problem problem = c.problem();
  const Eigen::Index n = problem.model->parameters.size();
  problem.prior = Prior{Eigen::VectorXd::Constant(n, 2e-3), Eigen::MatrixXd::Identity(n, n) / 3e-4};
  problem.readings.resize(8);
  const WeightedProblem weighted(problem, c.model_error(), c.active(), c.start());
  KalmanFilter filter(problem, c.active(), c.start(), DefaultP0(c));
  filter.LineariseAt(weighted.Start());
  for (size_t i = 0; i < problem.readings.size(); ++i)
    filter.Update(problem.readings[i], weighted.whiteners()[i]);
  ExpectEqual(filter, SolveBatch(weighted, weighted.Start(), DefaultP0(c)));
}

TEST(Kalman, BeginsAtTheStartWithItsCovariance) {
  const EstimatorCase c = SmallCase();
  const KalmanFilter filter(c.problem(), c.active(), c.start(), DefaultP0(c));
  EXPECT_LT(filter.state().norm(), 1e-15);
  EXPECT_LT((filter.covariance() - DefaultP0(c)).norm(), 1e-12 * DefaultP0(c).norm());
  EXPECT_EQ(filter.estimate().lambda.norm(), 0);
}

// A robust loss gives weight 0 to a gross error: the reading is not there.
TEST(Kalman, ReadingOfNoWeightChangesNothing) {
  const EstimatorCase c = SmallCase();
  KalmanFilter filter(c.problem(), c.active(), c.start(), DefaultP0(c));
  Reading gross = c.problem().readings[0];
  gross.X_MT.p.x() += 1;
  filter.Update(gross, ResidualMatrix::Zero(6, 6));
  EXPECT_LT(filter.state().norm(), 1e-15);
  EXPECT_LT((filter.covariance() - DefaultP0(c)).norm(), 1e-12 * DefaultP0(c).norm());
}

// Readings of 1 nm after a P_0 of 30 m. P falls by 1e20 there, more than the digits of P - K C P.
// The reference is a QR of all rows at once.
TEST(Kalman, PreciseReadingsAfterAVaguePrior) {
  const EstimatorCase c = SmallCase();
  const WeightedProblem weighted(c.problem(), {1e-9, 1e-9}, c.active(), c.start());
  KalmanFilter filter(c.problem(), c.active(), c.start(), 1e8 * DefaultP0(c));
  filter.LineariseAt(weighted.Start());
  for (size_t i = 0; i < c.problem().readings.size(); ++i) {
    filter.Update(c.problem().readings[i], weighted.whiteners()[i]);
    ASSERT_GT(filter.covariance().diagonal().minCoeff(), 0);
  }
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
  weighted.Linearise(weighted.Start(), &r, &J);
  const Eigen::Index n = J.cols();
  const Eigen::MatrixXd T = Eigen::HouseholderQR<Eigen::MatrixXd>(J).matrixQR().topRows(n);
  const Eigen::MatrixXd root =
      T.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(n, n));
  const Eigen::VectorXd sd = root.rowwise().norm();
  const Eigen::MatrixXd P = filter.covariance();
  for (Eigen::Index i = 0; i < n; ++i) EXPECT_NEAR(std::sqrt(P(i, i)) / sd(i), 1, 1e-8) << i;
}

// The mistake of passes that keep P: k passes would state deviations smaller by the root of k.
TEST(Kalman, PassesDoNotCountReadingsTwice) {
  const EstimatorCase c = SmallCase();
  std::vector<double> sd;
  for (int passes : {2, 8}) {
    SolveOptions options;
    options.kalman.passes = passes;
    Estimate estimate = c.start();
    const SolveSummary summary =
        FilterKalman(c.problem(), c.model_error(), c.active(), options, {}, &estimate);
    EXPECT_EQ(summary.iterations, passes);
    sd.push_back(std::sqrt(summary.covariance(20, 20)));
  }
  EXPECT_NEAR(sd[1] / sd[0], 1, 1e-3);
}

// A P_0 that is narrow against the errors holds the result at the start. That is no convergence.
TEST(Kalman, NarrowP0IsNotConvergence) {
  const EstimatorCase c = SmallCase();
  SolveOptions options;
  options.kalman.length_sd_m = 1e-7;
  options.kalman.angle_sd_rad = 1e-7;
  Estimate estimate = c.start();
  const SolveSummary summary =
      FilterKalman(c.problem(), c.model_error(), c.active(), options, {}, &estimate);
  EXPECT_EQ(summary.termination, Termination::kIterationLimit);
  EXPECT_NE(summary.message.find("is left"), std::string::npos) << summary.message;
}

// P_0 by role and unit: a frame may be far off, a compliance is in rad / (N m).
TEST(Kalman, InitialDeviations) {
  const Robot robot = testing::Stanford();
  Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  for (EffectGroup group : AllEffectGroups()) AddEffects(robot, group, &model);
  const Problem problem{&model, {}, {""}, {""}, {"wire"}};
  const auto sd = [&](const std::string& name) {
    const std::vector<int> active = {*Candidates(problem).Find(name)};
    return std::sqrt(InitialCovariance(problem, active, {})(0, 0));
  };
  EXPECT_DOUBLE_EQ(sd("base.x"), 0.1);
  EXPECT_DOUBLE_EQ(sd("tool.rz"), 0.175);
  EXPECT_DOUBLE_EQ(sd("offset[wire]"), 0.1);
  EXPECT_DOUBLE_EQ(sd("dq3"), 3e-3) << "joint 3 is prismatic";
  EXPECT_DOUBLE_EQ(sd("dq1"), 0.0175);
  EXPECT_DOUBLE_EQ(sd("gain1"), 1e-2);
  EXPECT_DOUBLE_EQ(sd("harmonic1_cos1"), 0.0175);
  EXPECT_DOUBLE_EQ(sd("compliance1"), 1e-4);
  EXPECT_DOUBLE_EQ(sd("compliance3"), 1e-6);
  EXPECT_DOUBLE_EQ(sd("temperature1"), 1e-4);
  EXPECT_DOUBLE_EQ(sd("temperature3"), 1e-4);
}

}  // namespace
}  // namespace truepose
