// The identified parameters of a SCARA depended on the order of the rows: all its axes are
// parallel, so the height of the target is a motion of the base, and it stayed wherever the best
// start had put it (-100, +100 or -1057 mm). At the true tilts of the axes that is a lever, which
// moved lengths by up to 17 standard deviations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/calibrate/calibrate.h"
#include "tests/core/testing/robots.h"
#include "tests/core/testing/simulated.h"

namespace truepose {
namespace {

using testing::kDeg;

Robot Scara() {
  return testing::DhRobot(
      {{0, 0.4, 0.3, 0}, {0, 0, 0.25, 180 * kDeg}, {0, 0.1, 0, 0}, {0, 0.05, 0, 0}}, "RRPR");
}

SimulateOptions Session() {
  SimulateOptions options;
  options.poses = 60;
  options.seed = 5;
  options.position_noise_sd_m = 2e-5;
  options.rotation_noise_sd_rad = 0.005 * kDeg;
  options.joint_noise_sd = 0.005 * kDeg;
  return options;
}

CalibrationProblem Shuffled(CalibrationProblem problem, uint64_t seed) {
  Random random(seed);
  for (size_t i = problem.readings.size() - 1; i > 0; --i)
    std::swap(problem.readings[i], problem.readings[random.Below(i + 1)]);
  return problem;
}

class ParametersByRowOrder : public ::testing::Test {
 protected:
  ParametersByRowOrder()
      : simulated_(Scara(), {Eigen::Matrix3d::Identity(), {0.02, 0.03, 0.08}}, Session()) {}

  CalibrationResult Calibrated(const CalibrationProblem& problem) {
    auto result = Calibrate(problem, {}, {});
    EXPECT_TRUE(result.ok()) << result.status();
    return *std::move(result);
  }

  testing::Simulated simulated_;
};

// 1e-6 of a deviation: what ten-digit covariances and convergence of the squares to 1e-12 leave.
TEST_F(ParametersByRowOrder, AreTheSame) {
  const CalibrationProblem problem = simulated_.Problem(ObservationKind::kPose, 0);
  const CalibrationResult first = Calibrated(problem);
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    const CalibrationResult again = Calibrated(Shuffled(problem, seed));
    ASSERT_EQ(again.identification.set.active, first.identification.set.active);
    const Eigen::VectorXd moved =
        again.identification.estimate.lambda - first.identification.estimate.lambda;
    for (size_t i = 0; i < first.identification.set.active.size(); ++i) {
      const int internal = first.identification.set.active[i] - 2 * kFrameParameters;
      if (internal < 0) continue;
      const auto place = static_cast<Eigen::Index>(i);
      const double sd = std::sqrt(first.identification.covariance(place, place));
      EXPECT_LT(std::abs(moved(internal)), 1e-6 * sd)
          << first.candidates[first.identification.set.active[i]].name << " seed " << seed;
    }
  }
}

// What nothing tells is where it was said to be: at the nominal tool, else at the flange.
TEST_F(ParametersByRowOrder, HeightOfTheTargetIsTheNominalOne) {
  CalibrationProblem problem = simulated_.Problem(ObservationKind::kPose, 0);
  EXPECT_NEAR(Calibrated(problem).identification.estimate.X_FT[0].p.z(), 0, 1e-9);
  problem.X_FT_nominal = Pose{Eigen::Matrix3d::Identity(), {0, 0, 0.08}};
  EXPECT_NEAR(Calibrated(problem).identification.estimate.X_FT[0].p.z(), 0.08, 1e-9);
}

}  // namespace
}  // namespace truepose
