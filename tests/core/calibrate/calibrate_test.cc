#include "core/calibrate/calibrate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/fault.h"
#include "core/identification/prediction.h"
#include "tests/core/testing/robots.h"
#include "tests/core/testing/simulated.h"

namespace truepose {
namespace {

using testing::AnyTarget;
using testing::Simulated;

SimulateOptions Noise(double position_m, double rotation_rad, int poses = 80) {
  SimulateOptions options;
  options.poses = poses;
  options.seed = 91;
  options.position_noise_sd_m = position_m;
  options.rotation_noise_sd_rad = rotation_rad;
  return options;
}

CalibrationResult MustCalibrate(const CalibrationProblem& problem,
                                const CalibrateOptions& options = {}) {
  auto result = Calibrate(problem, options, {});
  EXPECT_TRUE(result.ok()) << result.status();
  return *std::move(result);
}

// Without noise the true robot is found, whatever its kinematics: the control set is met to 1e-9 m.
// Would catch a model that is not complete (it could not follow) and a sign that the fit can't
// reach.
TEST(Calibrate, ExactReadingsAreMetExactly) {
  for (const testing::CountedRobot& counted : testing::CountedRobots()) {
    SCOPED_TRACE(counted.name);
    const Simulated simulated(counted.robot, AnyTarget(), Noise(0, 0));
    const CalibrationResult result = MustCalibrate(simulated.Problem());
    const PoseStatistics control = PoseStatisticsOf(result.control.after);
    EXPECT_EQ(control.poses, 40);
    EXPECT_LT(control.position_m.max, 1e-9);
    EXPECT_LT(control.rotation_rad.max, 1e-9);
    EXPECT_EQ(result.identification.set.active.size(), static_cast<size_t>(counted.parameters));
    EXPECT_EQ(result.identification.summary.termination, Termination::kConverged);
  }
}

// The deviations are those of the noise: errors of parameters over their deviations have mean
// square 1 (30 parameters over 20 sessions: 600 values, sd of the mean 0.06; dependent ones widen
// it). Would catch a covariance of another scale.
TEST(Calibrate, StandardDeviationsAreThoseOfTheErrors) {
  const Robot robot = testing::Stanford();
  double squares = 0;
  int count = 0;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    SimulateOptions options = Noise(2e-4, 3e-4);
    options.length_error_sd_m = options.angle_error_sd_rad = 0;  // the truth is zero in every basis
    options.seed = seed;
    const Simulated simulated(robot, AnyTarget(), options);
    const CalibrationResult result = MustCalibrate(simulated.Problem(ObservationKind::kPose, 0));
    const Identification& id = result.identification;
    for (size_t i = 0; i < id.set.active.size(); ++i) {
      const int internal = id.set.active[i] - 12;
      if (internal < 0) continue;
      const auto k = static_cast<Eigen::Index>(i);
      squares += id.estimate.lambda(internal) * id.estimate.lambda(internal) / id.covariance(k, k);
      ++count;
    }
    EXPECT_NEAR(id.weighted_residual_variance, 1, 1e-3);
    EXPECT_NEAR(id.model_error.position_sd_m, 2e-4, 3e-5);
  }
  EXPECT_EQ(count, 20 * 16);
  EXPECT_NEAR(squares / count, 1, 0.35);
}

// Dropped parameters stay at nominal to the bit, and all candidates are either active or named.
TEST(Calibrate, DroppedStayNominal) {
  const Simulated simulated(testing::Ur10(), AnyTarget(), Noise(1e-4, 1e-4));
  const CalibrationResult result = MustCalibrate(simulated.Problem());
  const IdentifiableSet& set = result.identification.set;
  EXPECT_EQ(set.active.size() + set.redundancies.size(),
            static_cast<size_t>(result.candidates.size()));
  for (const NullRelation& relation : set.redundancies) {
    EXPECT_TRUE(relation.structural) << RelationText(relation, result.candidates);
    EXPECT_EQ(result.identification.estimate.lambda(relation.dropped - 12), 0);
  }
}

// Two joints move: what the others do can't be seen. They stay nominal, are named, and the verdict
// is limited.
TEST(Calibrate, SessionThatMovesTwoJoints) {
  const Simulated simulated(testing::Ur10(), AnyTarget(), Noise(1e-4, 1e-4, 60));
  CalibrationProblem problem = simulated.Problem();
  Random random(92);
  Estimate truth{
      {simulated.session().X_MB}, {simulated.session().X_FT}, simulated.session().lambda};
  Problem all{&simulated.model(), {}, {""}, {""}};
  for (Reading& reading : problem.readings) {
    Eigen::VectorXd q = Eigen::VectorXd::Constant(6, 0.7);
    q(1) = random.Uniform(-1.5, 1.5);
    q(4) = random.Uniform(-1.5, 1.5);
    reading.q = q;
    reading.X_MT = Predict(all, reading, truth);
  }
  const auto result = Calibrate(problem, {}, {});
  // Two rotating axes leave a motion of base and tool that no reading can tell apart: refused by
  // name, not guessed.
  if (!result.ok()) {
    EXPECT_EQ(result.status().code(), absl::StatusCode::kFailedPrecondition);
    EXPECT_FALSE(FaultsOf(result.status()).empty());
    return;
  }
  EXPECT_LT(result->identification.set.active.size(), 30u);
  EXPECT_EQ(result->verdict.decision, Decision::kApplyWithinVolume);
}

// Readings at one configuration determine neither base nor tool.
TEST(CalibrateFaults, BaseAndToolNotDetermined) {
  const Simulated simulated(testing::Ur10(), AnyTarget(), Noise(1e-4, 1e-4));
  CalibrationProblem problem = simulated.Problem();
  for (Reading& reading : problem.readings) reading = problem.readings[0];
  const auto result = Calibrate(problem, {}, {});
  EXPECT_EQ(result.status().code(), absl::StatusCode::kFailedPrecondition);
  const auto faults = FaultsOf(result.status());
  ASSERT_EQ(faults.size(), 6u) << result.status();
  EXPECT_EQ(faults[0].field, "tool.x");
}

TEST(CalibrateFaults, AsManyParametersAsMeasuredValues) {
  const Simulated simulated(testing::Ur10(), AnyTarget(), Noise(1e-4, 1e-4, 5));
  const auto result = Calibrate(simulated.Problem(ObservationKind::kPose, 0), {}, {});
  EXPECT_EQ(result.status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(FaultsOf(result.status())[0].field, "readings");
}

TEST(CalibrateFaults, RequireComplete) {
  SimulateOptions options = Noise(1e-4, 1e-4, 60);
  options.joint_range_rad = 5e-4;  // hardly any motion: most parameters are too weak
  const Simulated simulated(testing::Ur10(), AnyTarget(), options);
  const CalibrationResult result = MustCalibrate(simulated.Problem());
  EXPECT_LT(result.identification.set.active.size(), 30u);
  EXPECT_EQ(result.verdict.reasons.empty(), false);
  CalibrateOptions strict;
  strict.require_complete = true;
  const auto refused = Calibrate(simulated.Problem(), strict, {});
  EXPECT_EQ(refused.status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_FALSE(FaultsOf(refused.status()).empty());
}

TEST(CalibrateFaults, CompleteSessionPassesRequireComplete) {
  const Simulated simulated(testing::Ur10(), AnyTarget(), Noise(1e-4, 1e-4));
  CalibrateOptions strict;
  strict.require_complete = true;
  EXPECT_TRUE(Calibrate(simulated.Problem(), strict, {}).ok());
}

TEST(CalibrateFaults, NothingToCalibrate) {
  CalibrationProblem empty;
  EXPECT_EQ(Calibrate(empty, {}, {}).status().code(), absl::StatusCode::kInvalidArgument);
  const Simulated simulated(testing::Ur10(), AnyTarget(), Noise(0, 0, 10));
  CalibrationProblem control_only = simulated.Problem();
  control_only.calibrates.assign(10, false);
  EXPECT_EQ(Calibrate(control_only, {}, {}).status().code(), absl::StatusCode::kInvalidArgument);
  control_only.calibrates.resize(3);
  EXPECT_EQ(Calibrate(control_only, {}, {}).status().code(), absl::StatusCode::kInvalidArgument);
}

// Cancelled at any iteration: the run ends with kCancelled and never with half a result.
TEST(CalibrateFaults, CancelledAtAnyMoment) {
  const Simulated simulated(testing::Ur10(), AnyTarget(), Noise(1e-4, 1e-4, 40));
  for (int after : {0, 1, 5, 12}) {
    int asked = 0;
    Hooks hooks;
    hooks.is_cancelled = [&] { return asked++ >= after; };
    EXPECT_EQ(Calibrate(simulated.Problem(), {}, hooks).status().code(),
              absl::StatusCode::kCancelled)
        << after;
  }
}

// Progress keeps to its stage's share, so a bar does not run to its end and wait there.
TEST(Calibrate, ProgressStaysInItsStage) {
  const Simulated simulated(testing::Ur10(), AnyTarget(), Noise(1e-4, 1e-4));
  Hooks hooks;
  hooks.on_progress = [](const Progress& progress) {
    const bool start = progress.stage == "start_values",
               identification = progress.stage == "identification";
    EXPECT_LE(progress.fraction, start ? 0.3 : identification ? 0.9 : 1.0) << progress.stage;
  };
  EXPECT_TRUE(Calibrate(simulated.Problem(), {}, hooks).ok());
}

// Control rows of a placement that has no calibration row: its base is fitted on them, and the
// result says so.
TEST(Calibrate, PlacementOfControlRowsOnly) {
  const Simulated simulated(testing::Ur10(), AnyTarget(), Noise(1e-4, 1e-4));
  CalibrationProblem problem = simulated.Problem();
  problem.placements = {"first", "second"};
  const Pose moved{ExpRotation<double>({0.1, 0.2, 0.3}), {1, 2, 3}};
  for (size_t i = 0; i < problem.readings.size(); ++i) {
    if (problem.calibrates[i]) continue;
    problem.readings[i].placement = 1;
    problem.readings[i].X_MT = moved * problem.readings[i].X_MT;
  }
  const CalibrationResult result = MustCalibrate(problem);
  EXPECT_EQ(result.base_fitted_on,
            (std::vector<FittedOn>{FittedOn::kCalibrationRows, FittedOn::kOwnRows}));
  EXPECT_EQ(result.tool_fitted_on, (std::vector<FittedOn>{FittedOn::kCalibrationRows}));
  EXPECT_LT(PoseStatisticsOf(result.control.after).position_m.rms, 3e-4);
  const Pose expected = moved * simulated.session().X_MB;
  EXPECT_LT((result.after_frames.X_MB[1].p - expected.p).norm(), 3e-3);
}

// The control set reports and never chooses: spoiling its measurements changes no identified value
// by a bit.
TEST(Calibrate, ControlRowsDoNotMoveTheResult) {
  const Simulated simulated(testing::Ur10(), AnyTarget(), Noise(1e-4, 1e-4));
  CalibrationProblem problem = simulated.Problem();
  const CalibrationResult clean = MustCalibrate(problem);
  for (size_t i = 0; i < problem.readings.size(); ++i) {
    if (!problem.calibrates[i]) problem.readings[i].X_MT.p.x() += 0.05;
  }
  const CalibrationResult spoiled = MustCalibrate(problem);
  EXPECT_EQ(clean.identification.estimate.lambda, spoiled.identification.estimate.lambda);
  EXPECT_GT(PoseStatisticsOf(spoiled.control.after).position_m.rms, 0.04);
  EXPECT_EQ(spoiled.verdict.decision, Decision::kDoNotApply);
}

// A calibration carried to a session of another placement and target of the same robot, and a fault
// when that session is too short to place instrument and target.
TEST(Evaluate, AnotherSessionOfTheSameRobot) {
  SimulateOptions options = Noise(1e-4, 1e-4);
  const Simulated first(testing::Ur10(), AnyTarget(), options);
  const CalibrationResult result = MustCalibrate(first.Problem());
  const Simulated same(testing::Ur10(), AnyTarget(), options);
  CalibrationProblem second = same.Problem(ObservationKind::kPose, 0);
  const Pose moved{ExpRotation<double>({0.5, -0.2, 1.3}), {1, -2, 0.5}},
      other{ExpRotation<double>({1, 0, 0}), {0.1, 0, 0.05}};
  for (Reading& reading : second.readings) reading.X_MT = moved * reading.X_MT * other;
  const auto evaluation =
      Evaluate(second, result.model, result.identification.estimate.lambda, {}, {});
  ASSERT_TRUE(evaluation.ok()) << evaluation.status();
  EXPECT_EQ(evaluation->set.after.size(), 80u);
  EXPECT_LT(PoseStatisticsOf(evaluation->set.after).position_m.rms, 3e-4);
  EXPECT_GT(PoseStatisticsOf(evaluation->set.before).position_m.rms, 8e-4);
  second.readings.resize(1);
  EXPECT_EQ(
      Evaluate(second, result.model, result.identification.estimate.lambda, {}, {}).status().code(),
      absl::StatusCode::kFailedPrecondition);
  second.readings.clear();
  EXPECT_EQ(
      Evaluate(second, result.model, result.identification.estimate.lambda, {}, {}).status().code(),
      absl::StatusCode::kInvalidArgument);
}

// A coupled robot: joint 3 of the chain is J2 + J3 of the controller.
TEST(Calibrate, JointMapIsApplied) {
  const Robot plain = testing::Ur10();
  JointMap map = JointMap::Identity(6);
  map.scale(2, 1) = 1;
  map.scale(3, 3) = -1;
  map.offset(4) = 0.3;
  const auto robot = Robot::Create(plain.joints(), plain.chain(), map);
  ASSERT_TRUE(robot.ok());
  const Simulated simulated(*robot, AnyTarget(), Noise(0, 0, 40));
  EXPECT_LT(PoseStatisticsOf(MustCalibrate(simulated.Problem()).control.after).position_m.max,
            1e-9);
}

// Pose matching: places that are known, joints that are read to 0.005 deg. Would catch weights that
// crawl towards an unexplained error of nothing: the run ended at its limit and must not be
// applied.
TEST(Calibrate, PoseMatchingSettlesItsWeights) {
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    SimulateOptions options = Noise(1e-6, 1e-6, 80);
    options.seed = seed;
    options.joint_noise_sd = 9e-5;
    const Simulated simulated(testing::MeasuringArm(), AnyTarget(), options);
    CalibrationProblem problem = simulated.Problem(ObservationKind::kPointAxis);
    for (Reading& reading : problem.readings) {
      reading.joint_sd = Eigen::VectorXd::Constant(5, 9e-5);
      reading.position_sd_m.setConstant(1e-6);
      reading.rotation_sd_rad = 1e-6;
    }
    const CalibrationResult result = MustCalibrate(problem);
    EXPECT_EQ(result.identification.summary.termination, Termination::kConverged)
        << "seed " << seed;
    // Three deviations of a chi-square with 200 - 25 degrees of freedom.
    EXPECT_NEAR(result.identification.weighted_residual_variance, 1, 0.33);
    EXPECT_NE(result.verdict.decision, Decision::kDoNotApply);
  }
}

}  // namespace
}  // namespace truepose
