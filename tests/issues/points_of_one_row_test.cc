// Symptom: with three reflectors a pose, joint effects were taken that the robot does not have, and
// a verdict rested on thirty control "rows" from ten poses. The points of one row share the joints'
// noise: they are one look at the robot, not three.
#include <gtest/gtest.h>

#include "core/calibrate/calibrate.h"
#include "core/calibrate/sets.h"
#include "tests/core/testing/robots.h"
#include "tests/core/testing/simulated.h"

namespace truepose {
namespace {

using testing::Simulated;

constexpr int kReflectors = 3;

// A tracker sees three reflectors; the joints are read with 0.03 deg of noise, the robot is rigid.
CalibrationProblem ThreeReflectors(const Simulated& simulated, uint64_t seed) {
  const Eigen::Vector3d places_T[kReflectors] = {
      {0.08, 0, 0.06}, {-0.04, 0.07, 0.06}, {-0.04, -0.07, 0.06}};
  Random random(seed);
  CalibrationProblem whole = simulated.Problem(ObservationKind::kPoint, 0);
  const std::vector<Reading> rows = std::move(whole.readings);
  whole.readings.clear();
  whole.targets = {"p1", "p2", "p3"};
  for (size_t row = 0; row < rows.size(); ++row) {
    for (int k = 0; k < kReflectors; ++k) {
      Reading reading = rows[row];
      reading.target = k;
      reading.row = static_cast<int>(row);
      reading.id = static_cast<int>(whole.readings.size());
      reading.X_MT.p = rows[row].X_MT * places_T[k];
      for (double& coordinate : reading.X_MT.p) coordinate += 2e-5 * random.Normal();
      whole.readings.push_back(reading);
    }
  }
  whole.calibrates.assign(whole.readings.size(), true);
  return whole;
}

SimulateOptions Session(uint64_t seed, int poses) {
  SimulateOptions options;
  options.poses = poses;
  options.seed = seed;
  options.position_noise_sd_m = 0;
  options.rotation_noise_sd_rad = 0;
  options.joint_noise_sd = 0.03 * testing::kDeg;
  options.joint_range_rad = 1;
  return options;
}

int FooledOf(int seeds, int poses) {
  int fooled = 0;
  for (uint64_t seed = 1; seed <= static_cast<uint64_t>(seeds); ++seed) {
    const Simulated simulated(testing::Ur10(), Pose{}, Session(seed, poses));
    CalibrateOptions options;
    options.effects = EffectsMode::kAuto;
    const auto result = Calibrate(ThreeReflectors(simulated, seed), options, {});
    EXPECT_TRUE(result.ok()) << result.status();
    fooled += result.ok() && !result->effect_groups.empty();
  }
  return fooled;
}

// 50 poses are too few for any effect. Catches a gate that counts 150 points.
TEST(PointsOfOneRow, FiftyPosesOfARigidRobotTakeNoEffects) { EXPECT_EQ(FooledOf(4, 50), 0); }

// 160 poses are enough to look. Catches folds that hold out one reflector of a pose and fit the
// other two, whose noise is the same. At most one of six may be fooled by chance.
TEST(PointsOfOneRow, FoldsHoldOutWholePoses) { EXPECT_LE(FooledOf(6, 160), 1); }

TEST(PointsOfOneRow, AreOneUnit) {
  const Units units = UnitsOfRows({4, 4, -1, 0, 4, -1, 0});
  EXPECT_EQ(units.of, (std::vector<int>{0, 0, 1, 2, 0, 3, 2}));
  EXPECT_EQ(units.count, 4);
}

// Nine poses with three points each: their number is said in poses, they are few, and an interval
// of nine draws is wider than that of 27. Catches each of the three counted in points.
TEST(PointsOfOneRow, TheVerdictCountsPoses) {
  std::vector<PoseError> before, after, apart_before, apart_after;
  Random random(3);
  for (int row = 0; row < 9; ++row) {
    const double b = 1e-3 * random.Uniform(0.5, 2), a = 8e-4 * random.Uniform(0.5, 2);
    for (int k = 0; k < kReflectors; ++k) {
      before.push_back({3 * row + k, b, -1, row});
      after.push_back({3 * row + k, a, -1, row});
      apart_before.push_back({3 * row + k, b, -1});
      apart_after.push_back({3 * row + k, a, -1});
    }
  }
  EXPECT_EQ(PoseStatisticsOf(before).poses, 9);
  const Interval together = BootstrapRatio(before, after),
                 apart = BootstrapRatio(apart_before, apart_after);
  // The root of three, less what 2,000 draws leave of it.
  EXPECT_GT(together.high - together.low, 1.5 * (apart.high - apart.low));
  Identification identification;
  identification.model_error = {5e-4, 5e-4};
  identification.summary.termination = Termination::kConverged;
  const Verdict verdict = Judge(identification, ParameterSet(), before, after);
  EXPECT_NE(verdict.decision, Decision::kApply);
  ASSERT_GE(verdict.reasons.size(), 2u);
  EXPECT_NE(verdict.reasons[0].find("only 9 control rows"), std::string::npos)
      << verdict.reasons[0];
  EXPECT_NE(verdict.reasons[1].find("over 9 rows"), std::string::npos) << verdict.reasons[1];
}

}  // namespace
}  // namespace truepose
