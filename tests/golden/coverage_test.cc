// Stated deviations of parameters are those of their errors (experiments E2): sessions of one
// small robot, new errors and noise in each. With 500 sessions a perfect estimator fails "93 to
// 97 % of each parameter" more often than not: that is asked of 5,000.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iostream>

#include "core/base/random.h"
#include "core/identification/identify.h"
#include "core/identification/prediction.h"
#include "core/models/model.h"
#include "tests/core/testing/robots.h"
#include "tests/golden/long_run.h"

namespace truepose {
namespace {

constexpr int kPoses = 40;
constexpr double kPositionNoise_m = 1e-4, kRotationNoise_rad = 2e-4;
constexpr double kJointNoise_rad = 3e-4;  // 0.1 to 0.3 mm at the target
constexpr double kErrors = 5e-4;          // m and rad
// Of s_model: finer moves no share of sessions, and takes thrice the time.
constexpr double kWeightTolerance = 1e-3;
constexpr double kNormal95 = 1.959964;

// Three revolute axes, askew: 4 R + 6 = 18 parameters of full poses.
Robot SmallRobot() {
  return testing::DhRobot(
      {{0, .4, .1, 80 * testing::kDeg}, {0, .05, .5, 20 * testing::kDeg}, {0, .1, .3, 0}}, "RRR");
}

// One robot with its model and what its readings determine at any poses.
class SmallSessions {
 public:
  explicit SmallSessions(bool joint_noise)
      : joint_noise_(joint_noise),
        robot_(SmallRobot()),
        model_(ModifiedIncremental(robot_, ModelExtent::kInternal)),
        generic_(GenericIdentifiable(OneReading(), robot_)) {}

  struct Session {
    Problem problem;
    Estimate truth;
  };

  // True errors are in the identified parameters alone, so that they are what is to be found.
  Session Draw(Random* random) const {
    Session session{{&model_, {}, {""}, {""}}, {}};
    session.truth.lambda = Eigen::VectorXd::Zero(model_.parameters.size());
    for (const int candidate : generic_.active) {
      if (candidate >= session.problem.FirstInternal())
        session.truth.lambda(candidate - session.problem.FirstInternal()) =
            kErrors * random->Normal();
    }
    session.truth.X_MB = {{ExpRotation<double>(testing::RandomVector(3, 1.5, random)),
                           testing::RandomVector(3, 2, random)}};
    session.truth.X_FT = {{ExpRotation<double>(testing::RandomVector(3, 1.5, random)),
                           testing::RandomVector(3, 0.2, random)}};
    for (int i = 0; i < kPoses; ++i)
      session.problem.readings.push_back(Measure(session.problem, session.truth, random));
    return session;
  }

  Identification Identified(const Session& session) const {
    IdentifyOptions options;
    options.weight_tolerance = kWeightTolerance;
    const auto before = FitFrames(session.problem, session.truth, options, {});
    EXPECT_TRUE(before.ok()) << before.status();
    Identification start = *before;
    start.estimate.lambda.setZero();
    const auto result = Identify(session.problem, generic_, start, options, {});
    EXPECT_TRUE(result.ok()) << result.status();
    return *result;
  }

  const IdentifiableSet& generic() const { return generic_; }

 private:
  Problem OneReading() const {
    Reading reading;
    reading.q = Eigen::VectorXd::Zero(3);
    return {&model_, {reading}, {""}, {""}};
  }

  Reading Measure(const Problem& problem, const Estimate& truth, Random* random) const {
    Reading reading;
    reading.q = testing::RandomVector(3, 1.5, random);
    reading.X_MT = Predict(problem, reading, truth);
    const auto normal = [&](double sd) {
      Eigen::Vector3d noise;
      for (double& value : noise) value = sd * random->Normal();
      return noise;
    };
    reading.X_MT.p += normal(kPositionNoise_m);
    reading.X_MT.R = ExpRotation<double>(normal(kRotationNoise_rad)) * reading.X_MT.R;
    if (!joint_noise_) return reading;
    reading.q += normal(kJointNoise_rad);
    reading.joint_sd = Eigen::Vector3d::Constant(kJointNoise_rad);
    return reading;
  }

  bool joint_noise_;
  Robot robot_;
  Model model_;
  IdentifiableSet generic_;
};

// Errors of the active candidates: corrections from the true frames, then parameters.
Eigen::VectorXd ErrorsOf(const SmallSessions::Session& session, const Identification& result) {
  const auto frame = [](const Pose& X, const Pose& truth) {
    Eigen::VectorXd d(6);
    d << X.p - truth.p, LogRotation<double>(X.R * truth.R.transpose());
    return d;
  };
  Eigen::VectorXd all(12 + session.truth.lambda.size());
  all << frame(result.estimate.X_MB[0], session.truth.X_MB[0]),
      frame(result.estimate.X_FT[0], session.truth.X_FT[0]),
      result.estimate.lambda - session.truth.lambda;
  return all(result.set.active);
}

struct Coverage {
  Eigen::ArrayXd inside;  // share of sessions, a parameter each
  Eigen::ArrayXd rms;     // of error / stated deviation
  double nees_ratio = 0;  // sqrt(mean NEES / p)
};

Coverage CoverageOf(bool joint_noise, int sessions) {
  const SmallSessions design(joint_noise);
  const auto p = static_cast<Eigen::Index>(design.generic().active.size());
  Coverage coverage{Eigen::ArrayXd::Zero(p), Eigen::ArrayXd::Zero(p)};
  Random random(20);
  for (int i = 0; i < sessions; ++i) {
    const auto session = design.Draw(&random);
    const Identification result = design.Identified(session);
    EXPECT_EQ(result.set.active, design.generic().active);
    if (result.set.active != design.generic().active) return coverage;
    const Eigen::VectorXd error = ErrorsOf(session, result);
    const Eigen::ArrayXd sizes = error.array().abs() / result.covariance.diagonal().array().sqrt();
    coverage.inside += (sizes < kNormal95).cast<double>() / sessions;
    coverage.rms += sizes.square() / sessions;
    coverage.nees_ratio +=
        error.dot(result.covariance.ldlt().solve(error)) / static_cast<double>(p * sessions);
  }
  coverage.rms = coverage.rms.sqrt();
  coverage.nees_ratio = std::sqrt(coverage.nees_ratio);
  std::cout << sessions << " sessions: pooled " << 100 * coverage.inside.mean() << " %, each "
            << 100 * coverage.inside.minCoeff() << " to " << 100 * coverage.inside.maxCoeff()
            << " %, RMS / Cramer-Rao at most " << coverage.rms.maxCoeff() << ", sqrt(NEES / p) "
            << coverage.nees_ratio << "\n";
  return coverage;
}

// What a perfect estimator's shares and ratios keep to: of 18 parameters and 100 sessions each
// share has a standard error of 2.2 %, RMS / Cramer-Rao one of 7 % and sqrt(NEES / p) one of 1.7 %;
// of 5,000 sessions a seventh of that.
struct Bounds {
  double pooled, nees, lowest, highest, rms;
};
constexpr Bounds kFew = {0.02, 0.05, 0.87, 1, 1.25}, kMany = {0.01, 0.02, 0.93, 0.97, 1.05};

class ParameterCoverage : public ::testing::TestWithParam<bool> {};

// Would catch a covariance of another scale, joint noise that does not reach R, weights that do not
// settle, and an estimator that is not efficient. Measured with 5,000 sessions: pooled 94.86 and
// 94.69 %, each 93.8 to 95.4 and 94.3 to 95.0 %, RMS / Cramer-Rao at most 1.025 and 1.022,
// sqrt(NEES / p) 1.007 and 1.015 (additive noise, noise of the joints); with 500: pooled 95.04 and
// 95.14 %, each 92.4 to 96.6 and 93.6 to 96.2 %.
TEST_P(ParameterCoverage, NinetyFivePercent) {
  const int sessions = testing::Draws(100, 5000);
  const Bounds& bounds = sessions < 5000 ? kFew : kMany;
  const Coverage coverage = CoverageOf(GetParam(), sessions);
  EXPECT_EQ(coverage.inside.size(), 18);
  EXPECT_NEAR(coverage.inside.mean(), 0.95, bounds.pooled);
  EXPECT_NEAR(coverage.nees_ratio, 1, bounds.nees);
  EXPECT_GE(coverage.inside.minCoeff(), bounds.lowest);
  EXPECT_LE(coverage.inside.maxCoeff(), bounds.highest);
  EXPECT_LE(coverage.rms.maxCoeff(), bounds.rms);
}

INSTANTIATE_TEST_SUITE_P(Noise, ParameterCoverage, ::testing::Values(false, true),
                         [](const auto& info) { return info.param ? "Joints" : "Additive"; });

}  // namespace
}  // namespace truepose
