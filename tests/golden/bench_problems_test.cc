// The common simulated problems: a right estimator reaches these figures, a nearly right one does
// not. Would catch a residual at the wrong point, wrong weights, a start value in another minimum,
// a missing parameter.
#include <gtest/gtest.h>

#include <cmath>

#include "core/calibrate/calibrate.h"
#include "core/identification/prediction.h"
#include "tests/core/testing/bench_problem.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using testing::BenchProblem;
using testing::kDeg;

CalibrationResult CalibrateAll(const BenchProblem& bench) {
  CalibrationProblem problem;
  problem.robot = &bench.robot;
  problem.readings = bench.readings;
  problem.calibrates.assign(bench.readings.size(), true);
  problem.placements = problem.targets = {""};
  auto result = Calibrate(problem, {}, {});
  EXPECT_TRUE(result.ok()) << result.status();
  return *std::move(result);
}

// RMS over 500 noise-free poses of the true robot, of position and of the observed rotation.
struct HeldOut {
  double position_mm, rotation_deg;
};

HeldOut ErrorOnTruth(const BenchProblem& bench, const CalibrationResult& result,
                     ObservationKind kind) {
  Random random(41);
  Problem problem{&result.model, {}, {""}, {""}};
  for (int i = 0; i < 500; ++i) {
    Reading reading;
    reading.kind = kind;
    reading.q = testing::RandomVector(bench.joints, 2.5, &random);
    reading.X_MT = Forward<double>(bench.truth, reading.q.data(), nullptr);
    reading.axis_M = reading.X_MT.R.col(2);
    problem.readings.push_back(reading);
  }
  const PoseStatistics s = PoseStatisticsOf(PoseErrors(problem, result.identification.estimate));
  return {1e3 * s.position_m.rms, s.rotation_rad.rms / kDeg};
}

TEST(BenchProblems, Arm6With81Poses) {
  const BenchProblem bench = testing::LoadBench("arm6", 81, ObservationKind::kPose);
  const CalibrationResult result = CalibrateAll(bench);
  EXPECT_EQ(result.identification.set.active.size(), 30u);
  EXPECT_EQ(result.identification.summary.termination, Termination::kConverged);
  EXPECT_GT(result.identification.weighted_residual_variance, 0.8);
  EXPECT_LT(result.identification.weighted_residual_variance, 1.2);
  const HeldOut error = ErrorOnTruth(bench, result, ObservationKind::kPose);
  EXPECT_LE(error.position_mm, 0.045);
  EXPECT_LE(error.rotation_deg, 0.004);
}

TEST(BenchProblems, Arm6With1000Poses) {
  const BenchProblem bench = testing::LoadBench("arm6", 1000, ObservationKind::kPose);
  const HeldOut error = ErrorOnTruth(bench, CalibrateAll(bench), ObservationKind::kPose);
  EXPECT_LE(error.position_mm, 0.018);
  EXPECT_LE(error.rotation_deg, 0.0013);
}

TEST(BenchProblems, Arm5WithPointAndAxis) {
  const BenchProblem bench = testing::LoadBench("arm5", 81, ObservationKind::kPointAxis);
  const CalibrationResult result = CalibrateAll(bench);
  EXPECT_EQ(result.identification.set.active.size(), 25u);
  const HeldOut error = ErrorOnTruth(bench, result, ObservationKind::kPointAxis);
  EXPECT_LE(error.position_mm, 0.036);
  EXPECT_LE(error.rotation_deg, 0.0033);
}

TEST(BenchProblems, Arm5WithPointsOnly) {
  const BenchProblem bench = testing::LoadBench("arm5", 81, ObservationKind::kPoint);
  const CalibrationResult result = CalibrateAll(bench);
  EXPECT_EQ(result.identification.set.active.size(), 23u);
  EXPECT_LE(ErrorOnTruth(bench, result, ObservationKind::kPoint).position_mm, 0.05);
}

// The variance components find the noise that made the readings: joint noise of 0.1 mrad over the
// arm's lengths beside 0.05 mm of the instrument gives about 0.09 mm an axis.
TEST(BenchProblems, ModelErrorIsThatOfTheNoise) {
  const CalibrationResult result =
      CalibrateAll(testing::LoadBench("arm6", 1000, ObservationKind::kPose));
  EXPECT_NEAR(1e3 * result.identification.model_error.position_sd_m, 0.09, 0.01);
  EXPECT_NEAR(result.identification.model_error.rotation_sd_rad, 1.8e-4, 2e-5);
}

}  // namespace
}  // namespace truepose
