// Partial recalibration from a stored calibration, and priors.
#include <gtest/gtest.h>

#include "core/calibrate/calibrate.h"
#include "tests/core/testing/robots.h"
#include "tests/core/testing/simulated.h"

namespace truepose {
namespace {

using testing::AnyTarget;
using testing::Simulated;

SimulateOptions Session(int poses) {
  SimulateOptions options;
  options.poses = poses;
  options.seed = 31;
  options.position_noise_sd_m = 1e-4;
  options.rotation_noise_sd_rad = 2e-4;
  return options;
}

StoredCalibration StoredOf(const CalibrationResult& result) {
  StoredCalibration stored;
  const ParameterSet& parameters = result.model.parameters;
  for (int i = 0; i < parameters.size(); ++i)
    stored.internal.emplace_back(parameters[i].name, result.identification.estimate.lambda(i));
  std::vector<int> places;
  for (size_t i = 0; i < result.identification.set.active.size(); ++i) {
    const Parameter& parameter = result.candidates[result.identification.set.active[i]];
    if (parameter.group != ParameterGroup::kInternal) continue;
    stored.identified.push_back(parameter.name);
    places.push_back(static_cast<int>(i));
  }
  stored.covariance = result.identification.covariance(places, places);
  stored.model_error = result.identification.model_error;
  return stored;
}

// Readings of the same true robot with dq3 moved by `change`, in other poses.
CalibrationProblem AfterRepair(const Simulated& simulated, double change, int poses,
                               uint64_t seed) {
  CalibrationProblem problem = simulated.Problem(ObservationKind::kPose, 0);
  Eigen::VectorXd truth = simulated.session().lambda;
  truth(*simulated.model().parameters.Find("dq3")) += change;
  Random random(seed);
  problem.readings.resize(static_cast<size_t>(poses));
  problem.calibrates.assign(problem.readings.size(), true);
  for (Reading& reading : problem.readings) {
    reading.q = testing::RandomVector(6, 1.5, &random);
    reading.X_MT = simulated.session().X_MB * Forward(simulated.model(), reading.q, truth) *
                   simulated.session().X_FT;
    for (int i = 0; i < 3; ++i) reading.X_MT.p(i) += 1e-4 * random.Normal();
    Eigen::Vector3d turn;
    for (int i = 0; i < 3; ++i) turn(i) = 2e-4 * random.Normal();
    reading.X_MT.R = ExpRotation<double>(turn) * reading.X_MT.R;
  }
  return problem;
}

class Recalibration : public ::testing::Test {
 protected:
  Recalibration() : simulated_(testing::Ur10(), AnyTarget(), Session(100)) {
    auto full = Calibrate(simulated_.Problem(ObservationKind::kPose, 0), {}, {});
    EXPECT_TRUE(full.ok()) << full.status();
    full_ = *std::move(full);
    options_.prior = PriorKind::kStored;
    options_.calibrate = "dq3";
    options_.stored = StoredOf(full_);
  }

  CalibrationResult Again(double change, int poses, uint64_t seed) {
    auto result = Calibrate(AfterRepair(simulated_, change, poses, seed), options_, {});
    EXPECT_TRUE(result.ok()) << result.status();
    return *std::move(result);
  }

  double Value(const CalibrationResult& result, const char* name) {
    return result.identification.estimate.lambda(*result.model.parameters.Find(name));
  }

  Simulated simulated_;
  CalibrationResult full_;
  CalibrateOptions options_;
};

// A motor was changed: five poses find the new offset, everything else stays to the bit.
TEST_F(Recalibration, OneJointAfterAMotorChange) {
  const CalibrationResult result = Again(5e-3, 5, 1);
  ASSERT_TRUE(result.change.has_value());
  EXPECT_TRUE(result.change->real);
  EXPECT_EQ(result.change->names, std::vector<std::string>{"dq3"});
  EXPECT_NEAR(Value(result, "dq3") - Value(full_, "dq3"), 5e-3, 4e-4);
  for (const Parameter& parameter : result.model.parameters) {
    if (parameter.name == "dq3") continue;
    EXPECT_EQ(Value(result, parameter.name.c_str()), Value(full_, parameter.name.c_str()));
  }
  EXPECT_LT(PoseStatisticsOf(result.calibration.after).position_m.rms,
            0.3 * PoseStatisticsOf(result.calibration.before).position_m.rms)
      << "before is the stored calibration";
}

// Nothing was changed: the test must say so at its own level. 60 sessions of 4 poses, p below 0.01
// in some: 0.6 are expected, more than 4 has a probability of 4e-4. p itself is uniform.
TEST_F(Recalibration, NoChangeIsChance) {
  int real = 0;
  double sum = 0;
  for (uint64_t seed = 1; seed <= 60; ++seed) {
    const CalibrationResult result = Again(0, 4, 100 + seed);
    real += result.change->real;
    sum += result.change->p_value;
    if (!result.change->real) {
      EXPECT_EQ(result.verdict.decision, Decision::kDoNotApply);
    }
  }
  EXPECT_LE(real, 4);
  EXPECT_NEAR(sum / 60, 0.5, 0.15) << "four standard errors of a uniform mean";
}

// The deviation of the new value covers its error: what is not known of the held parameters counts.
TEST_F(Recalibration, DeviationCoversTheHeldParameters) {
  double squares = 0;
  const int place = [&] {
    const CalibrationResult result = Again(2e-3, 4, 500);
    return static_cast<int>(result.identification.set.active.size()) - 1;
  }();
  for (uint64_t seed = 1; seed <= 40; ++seed) {
    const CalibrationResult result = Again(2e-3, 4, 1000 + seed);
    const double error = Value(result, "dq3") - Value(full_, "dq3") - 2e-3;
    squares += error * error / result.identification.covariance(place, place);
  }
  EXPECT_LT(squares / 40, 1.8) << "one stored calibration: its own error is one draw";
}

// dq1 is a motion of the base: asking for it by name is a fault, not a test of nothing.
TEST_F(Recalibration, AParameterThatNothingTellsIsAFault) {
  options_.calibrate = "dq1,dq3";
  const auto result = Calibrate(AfterRepair(simulated_, 0, 6, 4), options_, {});
  ASSERT_FALSE(result.ok());
  EXPECT_NE(result.status().message().find("dq1"), std::string::npos) << result.status();
  EXPECT_EQ(result.status().message().find("dq3"), std::string::npos) << result.status();
}

// The wrong joint is found anew: the readings don't fit, and it is said.
TEST_F(Recalibration, WhatElseHasChangedIsNoticed) {
  options_.calibrate = "dq5";
  const CalibrationResult result = Again(3e-3, 8, 6);
  EXPECT_EQ(result.verdict.decision, Decision::kDoNotApply);
  bool said = false;
  for (const std::string& reason : result.verdict.reasons)
    said = said || reason.find("do not fit what is held") != std::string::npos;
  EXPECT_TRUE(said);
}

TEST_F(Recalibration, BaseAloneNeedsItsTool) {
  options_.calibrate = "base";
  const auto without = Calibrate(AfterRepair(simulated_, 0, 5, 3), options_, {});
  ASSERT_FALSE(without.ok());
  EXPECT_NE(without.status().message().find("options.nominal_tool"), std::string::npos);
  CalibrationProblem problem = AfterRepair(simulated_, 0, 5, 3);
  problem.X_FT_nominal = simulated_.session().X_FT;
  const auto result = Calibrate(problem, options_, {});
  ASSERT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->identification.set.active.size(), 6u);
  EXPECT_EQ(result->identification.estimate.X_FT[0].p, simulated_.session().X_FT.p);
  EXPECT_LT((result->identification.estimate.X_MB[0].p - simulated_.session().X_MB.p).norm(), 5e-4);
}

// A prior as narrow as the truth is spread beats none where readings are few.
TEST(PriorOfTolerance, HelpsSmallSessions) {
  double with_squares = 0, without_squares = 0;
  for (uint64_t seed = 1; seed <= 10; ++seed) {
    SimulateOptions simulate = Session(40);
    simulate.seed = seed;
    simulate.length_error_sd_m = 3e-4;
    simulate.angle_error_sd_rad = 5e-4;
    simulate.position_noise_sd_m = 4e-4;
    simulate.rotation_noise_sd_rad = 5e-4;
    const Simulated simulated(testing::Ur10(), AnyTarget(), simulate);
    CalibrationProblem problem = simulated.Problem();
    for (size_t i = 0; i < problem.calibrates.size(); ++i) problem.calibrates[i] = i < 10;
    CalibrateOptions with;
    with.prior = PriorKind::kTolerance;
    const auto a = Calibrate(problem, with, {}), b = Calibrate(problem, {}, {});
    ASSERT_TRUE(a.ok() && b.ok()) << a.status() << b.status();
    with_squares += std::pow(PoseStatisticsOf(a->control.after).position_m.rms, 2);
    without_squares += std::pow(PoseStatisticsOf(b->control.after).position_m.rms, 2);
  }
  EXPECT_LT(with_squares, 0.9 * without_squares);
}

}  // namespace
}  // namespace truepose
