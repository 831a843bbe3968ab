#include "core/assessment/accuracy.h"

#include <gtest/gtest.h>

#include "core/assessment/places.h"
#include "core/calibrate/calibrate.h"
#include "tests/core/testing/robots.h"
#include "tests/core/testing/simulated.h"

namespace truepose {
namespace {

using testing::AnyTarget;
using testing::Simulated;

SimulateOptions Session(uint64_t seed, int poses) {
  SimulateOptions options;
  options.poses = poses;
  options.seed = seed;
  options.position_noise_sd_m = 2e-4;
  options.rotation_noise_sd_rad = 3e-4;
  return options;
}

// Normal noise: 95 % of the control readings are inside, whatever the number of readings, and the
// covariance of the parameters alone holds few. 8 sessions of 300 control rows: a standard error of
// 0.5 %, and the error of each session's scale beside it.
TEST(PredictedAccuracy, HoldsNinetyFivePercent) {
  double inside = 0, alone = 0, control = 0;
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    const Simulated simulated(testing::Ur10(), AnyTarget(), Session(seed, 340));
    CalibrationProblem problem = simulated.Problem();
    for (size_t i = 0; i < problem.calibrates.size(); ++i) problem.calibrates[i] = i < 40;
    const auto result = Calibrate(problem, {}, {});
    ASSERT_TRUE(result.ok()) << result.status();
    EXPECT_EQ(result->predicted.control, 300);
    inside += result->predicted.inside;
    alone += result->predicted.inside_covariance_alone;
    control += result->predicted.control;
    const double rms = PoseStatisticsOf(result->control.after).position_m.rms;
    EXPECT_NEAR(result->predicted.position_rms_m, rms, 0.15 * rms);
  }
  EXPECT_NEAR(inside / control, 0.95, 0.03);
  EXPECT_LT(alone / control, 0.6);
}

// Far from the measured poses the parameters are less sure.
TEST(PredictedAccuracy, UncertaintyGrowsAwayFromTheReadings) {
  SimulateOptions near = Session(3, 60);
  near.joint_range_rad = 0.3;
  const Simulated simulated(testing::Ur10(), AnyTarget(), near);
  const auto result = Calibrate(simulated.Problem(ObservationKind::kPose, 0), {}, {});
  ASSERT_TRUE(result.ok()) << result.status();
  Problem here = {&result->model, simulated.Problem().readings, {""}, {""}};
  Problem there = here;
  for (Reading& reading : there.readings) reading.q *= 4;
  EXPECT_GT(ParameterUncertainty(there, result->identification),
            3 * ParameterUncertainty(here, result->identification));
  EXPECT_EQ(result->verdict.decision, Decision::kApplyWithinVolume);
}

// Poses within 0.3 rad leave weak pairs (chapter-notes 29). All of them are named, and no other.
TEST(Correlations, AreThoseOfTheCovariance) {
  SimulateOptions near = Session(3, 60);
  near.joint_range_rad = 0.3;
  const Simulated simulated(testing::MeasuringArm(), AnyTarget(), near);
  const auto result = Calibrate(simulated.Problem(ObservationKind::kPointAxis, 0), {}, {});
  ASSERT_TRUE(result.ok()) << result.status();
  const Eigen::MatrixXd& C = result->identification.covariance;
  size_t strong = 0;
  for (Eigen::Index i = 0; i < C.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j)
      strong += C(i, j) * C(i, j) > 0.64 * C(i, i) * C(j, j);
  }
  EXPECT_GT(strong, 0u);
  EXPECT_EQ(result->correlations.size(), strong);
  for (const Correlation& correlation : result->correlations) {
    EXPECT_GT(std::abs(correlation.value), 0.8);
    EXPECT_LT(correlation.a, correlation.b);
  }
}

Reading Contact(int placement, const Eigen::Vector3d& p_M, const Eigen::VectorXd& q, int id) {
  Reading reading;
  reading.kind = ObservationKind::kPoint;
  reading.contact = true;
  reading.placement = placement;
  reading.X_MT.p = p_M;
  reading.q = q;
  reading.id = id;
  return reading;
}

// Two places of one placement, two readings each, one apart by a known angle; a third place has one
// reading and is left out.
TEST(Places, DistanceFromTheOwnMean) {
  const Robot robot = testing::DhRobot({{0, 0, 1, 0}}, "R");
  const Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  Problem problem{&model, {}, {"a", "b"}, {""}};
  const auto at = [](double angle) { return Eigen::VectorXd::Constant(1, angle); };
  problem.readings = {Contact(0, {0, 0, 0}, at(0), 0), Contact(0, {0, 0, 0}, at(0.002), 1),
                      Contact(0, {0.05, 0, 0}, at(0.0501), 2),
                      Contact(0, {0.05, 0, 0}, at(0.0521), 3), Contact(1, {0, 0, 0}, at(1), 4)};
  const PlaceErrors places = PlaceErrorsOf(problem, NominalEstimate(problem));
  ASSERT_EQ(places.errors.size(), 4u);
  for (const PoseError& error : places.errors) EXPECT_NEAR(error.position_m, 1e-3, 1e-8);
  EXPECT_NEAR(places.largest_spacing_error_m, 2 * std::sin(0.0501 / 2) - 0.05, 1e-6);
}

}  // namespace
}  // namespace truepose
