// Symptoms: calibrations made from each other claimed effects to be ever better known, since each
// added what is known of effects beforehand once more; and effects were chosen as if --prior
// tolerance had not been asked for.
#include <gtest/gtest.h>

#include <cmath>

#include "core/calibrate/calibrate.h"
#include "tests/core/testing/robots.h"
#include "tests/core/testing/simulated.h"

namespace truepose {
namespace {

using testing::Simulated;

constexpr int kRowsOfASession = 40;
constexpr ModelError kNoise{1e-3, 1e-3};

SimulateOptions Session() {
  SimulateOptions options;
  options.poses = 3 * kRowsOfASession;
  options.seed = 4;
  options.position_noise_sd_m = kNoise.position_sd_m;
  options.rotation_noise_sd_rad = kNoise.rotation_sd_rad;
  options.joint_range_rad = 0.5;  // the readings alone know gains no better than the prior
  return options;
}

// The thirds first .. last of the rows, each with an instrument and a target of its own.
CalibrationProblem Thirds(const Simulated& simulated, int first, int last) {
  CalibrationProblem problem = simulated.Problem(ObservationKind::kPose, 0);
  const std::vector<Reading> all = std::move(problem.readings);
  problem.readings.assign(all.begin() + first * kRowsOfASession,
                          all.begin() + (last + 1) * kRowsOfASession);
  problem.placements.clear();
  for (int third = first; third <= last; ++third)
    problem.placements.push_back(std::to_string(third));
  problem.targets = problem.placements;
  for (size_t i = 0; i < problem.readings.size(); ++i)
    problem.readings[i].placement = problem.readings[i].target =
        static_cast<int>(i) / kRowsOfASession;
  problem.calibrates.assign(problem.readings.size(), true);
  return problem;
}

CalibrateOptions WithGain() {
  CalibrateOptions options;
  options.effects = EffectsMode::kListed;
  options.effect_groups = {EffectGroup::kGain};
  // Weights and parameters as in every other run, so that only information differs.
  options.identify.known_model_error = kNoise;
  options.identify.identifiability.use_sd_bounds = false;
  return options;
}

StoredCalibration Stored(const CalibrationResult& result) {
  StoredCalibration stored;
  stored.convention = result.model.convention;
  stored.model_error = result.identification.model_error;
  for (int i = 0; i < result.model.parameters.size(); ++i)
    stored.internal.emplace_back(result.model.parameters[i].name,
                                 result.identification.estimate.lambda(i));
  std::vector<int> places;
  for (size_t i = 0; i < result.identification.set.active.size(); ++i) {
    const Parameter& parameter = result.candidates[result.identification.set.active[i]];
    if (parameter.group != ParameterGroup::kInternal) continue;
    places.push_back(static_cast<int>(i));
    stored.identified.push_back(parameter.name);
  }
  stored.covariance = result.identification.covariance(places, places);
  return stored;
}

// Catches: a prior of effects for each generation, which makes the gains of the third better known
// than by all readings at once. 2 %: derivatives move with the estimate, by thousandths.
TEST(EffectPrior, AChainOfCalibrationsKnowsWhatOneOfAllReadingsKnows) {
  const Simulated simulated(testing::Ur10(), testing::AnyTarget(), Session());
  const auto joint = Calibrate(Thirds(simulated, 0, 2), WithGain(), {});
  ASSERT_TRUE(joint.ok()) << joint.status();
  auto link = Calibrate(Thirds(simulated, 0, 0), WithGain(), {});
  ASSERT_TRUE(link.ok()) << link.status();
  for (int third = 1; third <= 2; ++third) {
    CalibrateOptions options = WithGain();
    options.prior = PriorKind::kStored;
    options.stored = Stored(*link);
    link = Calibrate(Thirds(simulated, third, third), options, {});
    ASSERT_TRUE(link.ok()) << link.status();
  }
  const StoredCalibration of_chain = Stored(*link), of_all = Stored(*joint);
  ASSERT_EQ(of_chain.identified, of_all.identified);
  for (size_t i = 0; i < of_all.identified.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    const double chain = std::sqrt(of_chain.covariance(k, k)),
                 all = std::sqrt(of_all.covariance(k, k));
    EXPECT_NEAR(chain / all, 1, 0.02) << of_all.identified[i];
  }
}

// Catches: a choice that frees what the prior holds. At a minimum the linearised fit moves nothing,
// so the first figure of the path is that of the calibration itself; 1e-3: the fits' tolerances.
TEST(EffectPrior, EffectsAreJudgedOnTheProblemThatIsSolved) {
  const Simulated simulated(testing::Ur10(), testing::AnyTarget(), Session());
  CalibrateOptions options;
  options.effects = EffectsMode::kAuto;
  options.prior = PriorKind::kTolerance;
  options.tolerance = {1e-6, 1e-6};  // next to nothing may move
  options.identify.known_model_error = ModelError{1e-4, 1e-4};
  options.effect_choice.least_gain = 1;  // none is taken
  const auto result = Calibrate(Thirds(simulated, 0, 0), options, {});
  ASSERT_TRUE(result.ok()) << result.status();
  double squares = 0;
  for (const PoseError& error : result->calibration.after)
    squares += error.position_m * error.position_m + error.rotation_rad * error.rotation_rad;
  const double rms = std::sqrt(squares / (6 * kRowsOfASession)) / 1e-4;
  ASSERT_FALSE(result->effects.path.empty());
  EXPECT_NEAR(result->effects.path[0].weighted_rms / rms, 1, 1e-3);
}

}  // namespace
}  // namespace truepose
