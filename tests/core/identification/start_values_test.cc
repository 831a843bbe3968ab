// Start values from any placement of instrument and target. Would catch a start that needs a guess,
// that needs turning tools, or that mixes up frames of several placements.
#include "core/identification/start_values.h"

#include <gtest/gtest.h>

#include "core/base/fault.h"
#include "core/identification/start_candidates.h"
#include "tests/core/testing/robots.h"
#include "tests/core/testing/simulated.h"

namespace truepose {
namespace {

using testing::RandomVector;

double Distance(const Pose& a, const Pose& b) { return (a.R - b.R).norm() + (a.p - b.p).norm(); }

Pose RandomPose(Random* random, double reach) {
  Eigen::Vector3d r = RandomVector(3, 1, random);
  r *= random->Uniform(0, 3.1) / r.norm();
  return {ExpRotation<double>(r), RandomVector(3, reach, random)};
}

Reading ExactReading(const Problem& problem, const Estimate& truth, ObservationKind kind,
                     int placement, int target, const Eigen::VectorXd& q) {
  Reading reading;
  reading.q = q;
  reading.kind = kind;
  reading.placement = placement;
  reading.target = target;
  reading.X_MT =
      truth.X_MB[placement] * Forward(problem.model->chain, q, truth.lambda) * truth.X_FT[target];
  reading.axis_M = reading.X_MT.R.col(2);
  return reading;
}

Estimate MustFind(const Problem& problem, const StartOptions& options = {}) {
  auto start = FindStart(problem, options, {});
  EXPECT_TRUE(start.ok()) << start.status();
  return *std::move(start);
}

// Thirty placements and targets anywhere, 12 readings each, for every kind of measurement: exact
// data must be met exactly.
class StartValues : public ::testing::TestWithParam<ObservationKind> {};

TEST_P(StartValues, AnyPlacementOfInstrumentAndTarget) {
  const Model model = ModifiedIncremental(testing::Ur10(), ModelExtent::kInternal);
  for (uint64_t seed = 1; seed <= 30; ++seed) {
    Random random(seed);
    Problem problem{&model, {}, {""}, {""}};
    Estimate truth = NominalEstimate(problem);
    truth.X_MB[0] = RandomPose(&random, 3);
    truth.X_FT[0] = RandomPose(&random, 0.4);
    for (int i = 0; i < 12; ++i)
      problem.readings.push_back(
          ExactReading(problem, truth, GetParam(), 0, 0, RandomVector(6, 1.5, &random)));
    const Estimate start = MustFind(problem);
    EXPECT_LT(Distance(start.X_MB[0], truth.X_MB[0]), 1e-6) << seed;
    EXPECT_LT((start.X_FT[0].p - truth.X_FT[0].p).norm(), 1e-6) << seed;
    if (GetParam() == ObservationKind::kPose) {
      EXPECT_LT(Distance(start.X_FT[0], truth.X_FT[0]), 1e-6) << seed;
    }
    if (GetParam() == ObservationKind::kPointAxis) {
      EXPECT_LT((start.X_FT[0].R.col(2) - truth.X_FT[0].R.col(2)).norm(), 1e-6) << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, StartValues,
                         ::testing::Values(ObservationKind::kPose, ObservationKind::kPoint,
                                           ObservationKind::kPointAxis),
                         [](const auto& info) { return std::string(KindOf(info.param).name); });

// Nearly constant tool orientation, a real robot's error: linear starts end at 2.5 to 6 mm, the
// right minimum is below.
TEST(StartValuesHard, NearlyConstantOrientation) {
  const Robot robot = testing::Ur10();
  const Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  Random random(81);
  Problem problem{&model, {}, {""}, {""}};
  Estimate truth = NominalEstimate(problem);
  truth.X_MB[0] = RandomPose(&random, 3);
  truth.X_FT[0] = {Eigen::Matrix3d::Identity(), {0, 0, 0.109}};
  for (Eigen::Index i = 0; i < truth.lambda.size(); ++i) truth.lambda(i) = 3e-4 * random.Normal();
  while (problem.readings.size() < 100) {
    Eigen::VectorXd q = RandomVector(6, 1.2, &random);
    q(3) = -1.57 - q(1) - q(2) + 0.02 * random.Normal();  // tool down
    q(4) = -1.57 + 0.02 * random.Normal();
    q(5) = q(0) + 0.02 * random.Normal();  // and not turning
    problem.readings.push_back(ExactReading(problem, truth, ObservationKind::kPose, 0, 0, q));
  }
  const Estimate start = MustFind(problem);
  double squares = 0;
  for (const Reading& reading : problem.readings) {
    squares += (reading.X_MT.p -
                start.X_MB[0] * Forward(model.chain, reading.q, start.lambda) * start.X_FT[0].p)
                   .squaredNorm();
  }
  EXPECT_LT(std::sqrt(squares / 100), 1.5e-3);
}

// Three placements and two targets; one placement has three readings only, one pair none: frames
// follow from each other.
TEST(StartValuesHard, SeveralPlacementsAndTargets) {
  const Model model = ModifiedIncremental(testing::Panda(), ModelExtent::kInternal);
  Random random(82);
  Problem problem{&model, {}, {"left", "right", "front"}, {"a", "b"}};
  Estimate truth = NominalEstimate(problem);
  for (Pose& X : truth.X_MB) X = RandomPose(&random, 3);
  for (Pose& X : truth.X_FT) X = RandomPose(&random, 0.3);
  const int counts[3][2] = {{12, 0}, {0, 3}, {3, 8}};
  for (int p = 0; p < 3; ++p) {
    for (int t = 0; t < 2; ++t) {
      for (int i = 0; i < counts[p][t]; ++i) {
        problem.readings.push_back(ExactReading(problem, truth, ObservationKind::kPose, p, t,
                                                RandomVector(7, 1, &random)));
      }
    }
  }
  const Estimate start = MustFind(problem);
  for (int p = 0; p < 3; ++p) EXPECT_LT(Distance(start.X_MB[p], truth.X_MB[p]), 1e-5) << p;
  for (int t = 0; t < 2; ++t) EXPECT_LT(Distance(start.X_FT[t], truth.X_FT[t]), 1e-5) << t;
}

// Known frames are not touched, the unknown placement is found with them.
TEST(StartValuesHard, KnownFramesStay) {
  const Model model = ModifiedIncremental(testing::Ur10(), ModelExtent::kInternal);
  Random random(83);
  Problem problem{&model, {}, {"old", "new"}, {"t"}};
  Estimate truth = NominalEstimate(problem);
  truth.X_MB = {RandomPose(&random, 3), RandomPose(&random, 3)};
  truth.X_FT[0] = RandomPose(&random, 0.2);
  for (int i = 0; i < 3; ++i)
    problem.readings.push_back(
        ExactReading(problem, truth, ObservationKind::kPoint, 1, 0, RandomVector(6, 1, &random)));
  StartOptions options;
  options.known = truth;
  options.base_known = {true, false};
  options.tool_known = {true};
  const Estimate start = MustFind(problem, options);
  EXPECT_EQ(Distance(start.X_MB[0], truth.X_MB[0]), 0);
  EXPECT_EQ(Distance(start.X_FT[0], truth.X_FT[0]), 0);
  EXPECT_LT(Distance(start.X_MB[1], truth.X_MB[1]), 1e-9);
}

TEST(StartValuesFaults, FrameWithoutReadings) {
  const Model model = ModifiedIncremental(testing::Ur10(), ModelExtent::kInternal);
  Problem problem{&model, {Reading{}}, {"here", "nowhere"}, {""}};
  problem.readings[0].q = Eigen::VectorXd::Zero(6);
  const auto start = FindStart(problem, {}, {});
  EXPECT_EQ(start.status().code(), absl::StatusCode::kFailedPrecondition);
  const auto faults = FaultsOf(start.status());
  ASSERT_EQ(faults.size(), 1u);
  EXPECT_EQ(faults[0].field, "placement 'nowhere'");
}

TEST(StartValuesFaults, Cancelled) {
  const Model model = ModifiedIncremental(testing::Ur10(), ModelExtent::kInternal);
  Problem problem{&model, {Reading{}}, {""}, {""}};
  problem.readings[0].q = Eigen::VectorXd::Zero(6);
  Hooks hooks;
  hooks.is_cancelled = [] { return true; };
  EXPECT_EQ(FindStart(problem, {}, hooks).status().code(), absl::StatusCode::kCancelled);
}

}  // namespace
}  // namespace truepose
