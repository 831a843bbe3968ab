// What holds for every estimator: the same estimate from any kinds of readings, candidates that are
// not active stay, and a solve that ends without a result leaves everything as it was.
#include "core/identification/solve.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "core/identification/prediction.h"
#include "tests/core/testing/estimator_case.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using testing::OptionsFor;
using testing::RandomVector;

// A robot with errors of 1 mm and 3 mrad seen by everything at once: two placements, poses, points,
// distances with an unknown constant, and a prior; noise of 0.05 mm and 0.1 mrad.
class Mixed : public ::testing::TestWithParam<Estimator> {
 protected:
  Mixed() : random_(91), model_(ModifiedIncremental(testing::Ur10(), ModelExtent::kInternal)) {
    problem_ = {&model_, {}, {"a", "b"}, {"ball"}, {"wire"}};
    truth_ = NominalEstimate(problem_);
    start_ = truth_;
    truth_.lambda = RandomVector(model_.parameters.size(), 1.5e-3, &random_);
    truth_.offsets(0) = 0.012;
    truth_.X_FT[0].p = start_.X_FT[0].p = Eigen::Vector3d(0.06, -0.04, 0.15);
    truth_.X_MB[1] = {ExpRotation<double>({0.1, -0.2, 1.0}), Eigen::Vector3d(1, -2, 0.3)};
    const double nearly[] = {2e-3, -1e-3, 3e-3, 1e-3, -2e-3, 2e-3};
    start_.X_MB[1] = Corrected(truth_.X_MB[1], nearly, nullptr);
    for (int i = 0; i < 90; ++i) problem_.readings.push_back(Read(i));
    problem_.prior = Prior{Eigen::VectorXd::Constant(model_.parameters.size(), 1e-4),
                           Eigen::MatrixXd::Identity(3, model_.parameters.size()) / 2e-4};
    Choose();
  }

  SolveSummary SolveBy(Estimator estimator, Estimate* estimate, const Hooks& hooks = {}) const {
    *estimate = start_;
    SolveOptions options = OptionsFor(estimator);
    options.simplex.max_evaluations = 20'000;  // 36 parameters
    return Solve(problem_, model_error_, active_, options, hooks, estimate);
  }

  void ExpectStart(const Estimate& estimate) const {
    EXPECT_EQ(estimate.lambda, start_.lambda);
    EXPECT_EQ(estimate.offsets, start_.offsets);
    EXPECT_EQ(estimate.X_MB[1].R, start_.X_MB[1].R);
    EXPECT_EQ(estimate.X_MB[1].p, start_.X_MB[1].p);
    EXPECT_EQ(estimate.X_FT[0].p, start_.X_FT[0].p);
  }

  Random random_;
  Model model_;
  Problem problem_;
  Estimate truth_, start_;
  ModelError model_error_{5e-5, 1e-4};
  std::vector<int> active_;

 private:
  Eigen::Vector3d Noise(double sd) {
    return sd * Eigen::Vector3d(random_.Normal(), random_.Normal(), random_.Normal());
  }

  Reading Read(int i) {
    constexpr ObservationKind kKinds[] = {ObservationKind::kPose, ObservationKind::kPoint,
                                          ObservationKind::kDistance};
    Reading reading;
    reading.kind = kKinds[i % 3];
    reading.placement = i % 2;
    reading.q = RandomVector(6, 1.5, &random_);
    const Pose X_MT = Predict(problem_, reading, truth_);
    reading.X_MT.p = X_MT.p + Noise(5e-5);
    reading.X_MT.R = ExpRotation<double>(Noise(1e-4)) * X_MT.R;
    if (reading.kind != ObservationKind::kDistance) return reading;
    reading.offset = 0;
    reading.anchor_M = Eigen::Vector3d(0.5, 1.5, -0.2);
    reading.distance_m = (reading.X_MT.p - reading.anchor_M).norm() + truth_.offsets(0);
    return reading;
  }

  // What the readings determine but a turn of the first base, which is held.
  void Choose() {
    const IdentifiableSet set =
        Identifiable(Whitened(problem_, start_, model_error_).J, Candidates(problem_), {});
    for (int candidate : set.active) {
      if (candidate != held_) active_.push_back(candidate);
    }
  }

 protected:
  static constexpr int held_ = 4;  // base[a].ry
};

// Would catch an estimator without a column for the constant, the second placement or the prior.
// The same minimum to a tenth of a standard deviation: the simplex is the coarsest.
TEST_P(Mixed, EndsInTheSameEstimate) {
  Estimate lm, estimate;
  const SolveSummary expected = SolveBy(Estimator::kLevenbergMarquardt, &lm);
  const SolveSummary summary = SolveBy(GetParam(), &estimate);
  EXPECT_EQ(summary.termination, Termination::kConverged) << summary.message;
  EXPECT_NEAR(summary.initial_cost / expected.initial_cost, 1, 1e-12);
  EXPECT_NEAR(summary.final_cost / expected.final_cost, 1, 1e-3);
  EXPECT_GT(summary.initial_cost, 100 * summary.final_cost) << "nothing to do proves nothing";
  EXPECT_NEAR(estimate.offsets(0), lm.offsets(0), 2e-5);
  EXPECT_NEAR(lm.offsets(0), truth_.offsets(0), 2e-4);
  EXPECT_LT((estimate.X_MB[1].p - lm.X_MB[1].p).norm(), 5e-5);
}

// Frames that are moved step by step turn about held axes, too: then a nested model is not nested.
TEST_P(Mixed, HoldsWhatIsNotActive) {
  Estimate estimate;
  SolveBy(GetParam(), &estimate);
  const std::set<int> active(active_.begin(), active_.end());
  for (Eigen::Index i = 0; i < estimate.lambda.size(); ++i) {
    if (active.contains(problem_.FirstInternal() + static_cast<int>(i))) continue;
    EXPECT_EQ(estimate.lambda(i), start_.lambda(i));
  }
  // R(x) R(y) R(z) with R(y) = 1: its element (0, 2) is sin of the turn about y.
  EXPECT_NEAR(estimate.X_MB[0].R(0, 2), 0, 1e-15);
  EXPECT_NE(estimate.X_MB[0].R(0, 1), 0);
}

TEST_P(Mixed, WithoutActiveCandidatesNothingIsDone) {
  active_.clear();
  Estimate estimate;
  const SolveSummary summary = SolveBy(GetParam(), &estimate);
  EXPECT_EQ(summary.termination, Termination::kConverged);
  EXPECT_EQ(summary.initial_cost, summary.final_cost);
  EXPECT_GT(summary.final_cost, 0);
  ExpectStart(estimate);
}

// Cancelled before the first step and in the middle; progress was reported before.
TEST_P(Mixed, CancellationLeavesTheEstimate) {
  for (int asked_before : {0, 2}) {
    int asked = 0;
    Hooks hooks;
    hooks.is_cancelled = [&] { return asked++ >= asked_before; };
    Estimate estimate;
    EXPECT_EQ(SolveBy(GetParam(), &estimate, hooks).termination, Termination::kCancelled);
    ExpectStart(estimate);
  }
}

TEST_P(Mixed, ReportsProgress) {
  std::vector<Progress> reports;
  Hooks hooks;
  hooks.on_progress = [&](const Progress& progress) { reports.push_back(progress); };
  Estimate estimate;
  SolveBy(GetParam(), &estimate, hooks);
  ASSERT_GE(reports.size(), 2u);
  EXPECT_GT(reports.back().iteration, reports.front().iteration);
  EXPECT_LE(reports.back().cost, reports.front().cost);
}

TEST_P(Mixed, FailureLeavesTheEstimate) {
  problem_.readings[4].X_MT.p.x() = std::numeric_limits<double>::quiet_NaN();
  Estimate estimate;
  EXPECT_EQ(SolveBy(GetParam(), &estimate).termination, Termination::kFailed);
  ExpectStart(estimate);
}

INSTANTIATE_TEST_SUITE_P(Estimators, Mixed, ::testing::ValuesIn(testing::kEstimators),
                         [](const auto& info) { return std::string(Name(info.param)); });

}  // namespace
}  // namespace truepose
