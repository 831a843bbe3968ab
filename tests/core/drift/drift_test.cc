#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/base/fault.h"
#include "core/base/random.h"
#include "core/drift/drift_check.h"
#include "core/drift/drift_parts.h"
#include "core/drift/drift_tests.h"
#include "core/drift/error_field.h"
#include "tests/core/testing/robots.h"
#include "tests/core/testing/simulated.h"

namespace truepose {
namespace {

using testing::kDeg;

// A UR10 as its calibration has it, exactly; checks of it with any changes, noise as it is stated.
class DriftTest : public ::testing::Test {
 protected:
  static constexpr double kPosition_m = 5e-5, kRotation_rad = 1e-4;

  DriftTest()
      : robot_(testing::Ur10()), model_(ModifiedIncremental(robot_, ModelExtent::kInternal)) {
    X_MB_ = {ExpRotation<double>({0.3, -0.2, 1.1}), Eigen::Vector3d(1.5, -2, 0.4)};
    X_FT_ = testing::AnyTarget();
    lambda_ = testing::RandomVector(model_.parameters.size(), 5e-4, &random_);
    changed_X_MB_ = X_MB_;
    changed_X_FT_ = X_FT_;
  }

  // Stated noise alone; s_model half of it.
  DriftProblem Check(int poses, double noise = 1) {
    DriftProblem problem;
    problem.robot = &robot_;
    problem.check.model = &model_;
    problem.check.placements = problem.check.targets = {""};
    for (int i = 0; i < poses; ++i) problem.check.readings.push_back(Measure(noise));
    problem.active = {{X_MB_}, {X_FT_}, lambda_};
    problem.base_held = problem.tool_held = {true};
    const int n = problem.check.CandidateCount();
    problem.covariance = Eigen::MatrixXd::Zero(n, n);
    problem.model_error = {kPosition_m / 2, kRotation_rad / 2};
    problem.X_FT_nominal = X_FT_;
    return problem;
  }

  Reading Measure(double noise) {
    Reading reading;
    reading.q = testing::RandomVector(6, 1.5, &random_);
    reading.position_sd_m.setConstant(kPosition_m);
    reading.rotation_sd_rad = kRotation_rad;
    reading.X_MT = changed_X_MB_ * Forward(model_, reading.q + offset_, lambda_) * changed_X_FT_;
    reading.X_MT.p += noise * kPosition_m * Normal();
    reading.X_MT.R = ExpRotation<double>(noise * kRotation_rad * Normal()) * reading.X_MT.R;
    return reading;
  }

  Eigen::Vector3d Normal() { return {random_.Normal(), random_.Normal(), random_.Normal()}; }

  static DriftCheckResult MustCheck(const DriftProblem& problem) {
    const auto result = CheckDrift(problem);
    EXPECT_TRUE(result.ok()) << result.status();
    return result.ok() ? *result : DriftCheckResult();
  }

  static bool Says(const DriftCheckResult& result, const std::string& text) {
    for (const std::string& finding : result.findings)
      if (finding.find(text) != std::string::npos) return true;
    return false;
  }

  Random random_{7};
  Robot robot_;
  Model model_;
  Pose X_MB_, X_FT_, changed_X_MB_, changed_X_FT_;
  Eigen::VectorXd lambda_, offset_ = Eigen::VectorXd::Zero(6);
};

TEST_F(DriftTest, NothingChanged) {
  const DriftCheckResult result = MustCheck(Check(20));
  EXPECT_FALSE(result.changed);
  EXPECT_EQ(result.attributed_to, "");
  EXPECT_EQ(result.degrees_of_freedom, 120);
  EXPECT_EQ(result.parts.size(), 6u);
  // Noise of 0.05 mm in three axes; 60 values tell it to 9 %.
  EXPECT_NEAR(result.position_m.rms, std::sqrt(3.0) * kPosition_m,
              0.3 * std::sqrt(3.0) * kPosition_m);
  EXPECT_TRUE(Says(result, "Nothing has changed"));
}

// Each part by its own physical change, with its size; 3 deg is far from linear. Would catch a
// sign, a unit, or an offset of the model's parametrisation in place of the joint's motion.
TEST_F(DriftTest, EachPartWithItsSize) {
  for (int joint = 1; joint <= 4; ++joint) {
    for (double angle : {0.05 * kDeg, -3 * kDeg}) {
      offset_.setZero();
      offset_(joint) = angle;
      const DriftCheckResult result = MustCheck(Check(20));
      EXPECT_TRUE(result.changed);
      EXPECT_EQ(result.attributed_to, "joint " + std::to_string(joint + 1)) << angle;
      ASSERT_FALSE(result.parts.empty());
      // Five deviations of the joint that 20 poses tell worst, the fifth (3e-5 rad).
      EXPECT_NEAR(result.parts[0].change_rad, std::abs(angle), 1.5e-4) << joint;
      EXPECT_EQ(result.parts[0].change_m, 0);
    }
  }
}

TEST_F(DriftTest, BaseAndJoint1) {
  changed_X_MB_.p += Eigen::Vector3d(4e-4, 0, -3e-4);
  DriftCheckResult result = MustCheck(Check(20));
  EXPECT_EQ(result.attributed_to, "base or joint 1");
  EXPECT_NEAR(result.parts[0].change_m, 5e-4, 1e-4);  // turned by the noise: some sd
  changed_X_MB_ = X_MB_;
  offset_(0) = 0.05 * kDeg;
  result = MustCheck(Check(20));
  EXPECT_EQ(result.attributed_to, "base or joint 1");
  EXPECT_NEAR(result.parts[0].change_rad, 0.05 * kDeg, 1.5e-4);
}

TEST_F(DriftTest, ToolAndLastJoint) {
  changed_X_FT_.p += Eigen::Vector3d(0, 5e-4, 0);
  DriftCheckResult result = MustCheck(Check(20));
  EXPECT_EQ(result.attributed_to, "tool or last joint");
  EXPECT_NEAR(result.parts[0].change_m, 5e-4, 1e-4);
  changed_X_FT_ = X_FT_;
  offset_(5) = 0.05 * kDeg;
  EXPECT_EQ(MustCheck(Check(20)).attributed_to, "tool or last joint");
}

// An instrument set up anew and another target: no alarm, they are no parts and it says so; a joint
// is still found.
TEST_F(DriftTest, FramesThatMayHaveMoved) {
  changed_X_MB_ = {ExpRotation<double>({-0.5, 0.1, 2}), Eigen::Vector3d(-2, 1, 0)};
  changed_X_FT_.p += Eigen::Vector3d(0.01, -0.02, 0.03);
  DriftProblem problem = Check(20);
  problem.base_held = problem.tool_held = {false};
  DriftCheckResult result = MustCheck(problem);
  EXPECT_FALSE(result.changed);
  EXPECT_FALSE(result.base_observable);
  EXPECT_EQ(result.degrees_of_freedom, 108);
  EXPECT_EQ(result.parts.size(), 4u);
  EXPECT_TRUE(Says(result, "base: not observable"));
  EXPECT_TRUE(Says(result, "tool: not observable"));
  offset_(2) = 0.05 * kDeg;
  problem = Check(20);
  problem.base_held = problem.tool_held = {false};
  EXPECT_EQ(MustCheck(problem).attributed_to, "joint 3");
}

// Two joints at once are no single part's change. Would catch a name that stands for half of it,
// and changes that are told of the wrong one.
TEST_F(DriftTest, TwoChangesAreNotOne) {
  offset_(1) = 0.06 * kDeg;
  offset_(4) = -0.1 * kDeg;
  const DriftCheckResult result = MustCheck(Check(30));
  EXPECT_TRUE(result.changed);
  EXPECT_EQ(result.attributed_to, "joint 2 and joint 5");
  ASSERT_EQ(result.together.size(), 2u);
  // Instrument noise, and what the calibration leaves uncertain, are a tenth of these.
  EXPECT_NEAR(result.together[0].change_rad, 0.06 * kDeg, 0.02 * kDeg);
  EXPECT_NEAR(result.together[1].change_rad, 0.1 * kDeg, 0.03 * kDeg);
  EXPECT_TRUE(Says(result, "No single part"));
}

// Three at once are not two. Would catch a pair that is named whatever it leaves.
TEST_F(DriftTest, ThreeChangesAreNotTwo) {
  offset_(1) = 0.06 * kDeg;
  offset_(2) = 0.08 * kDeg;
  offset_(4) = -0.1 * kDeg;
  const DriftCheckResult result = MustCheck(Check(30));
  EXPECT_TRUE(result.changed);
  EXPECT_EQ(result.attributed_to, "");
  EXPECT_TRUE(result.together.empty());
}

// A robot that has become rough: no part moves, every reading scatters. Would catch a test of the
// parts' directions alone.
TEST_F(DriftTest, ScatterAloneIsAChangeOfNoPart) {
  const DriftCheckResult result = MustCheck(Check(30, 2.5));
  EXPECT_TRUE(result.changed);
  EXPECT_EQ(result.attributed_to, "");
  EXPECT_TRUE(Says(result, "beyond chance"));
}

// What the calibration does not know of a joint is no change of it.
TEST_F(DriftTest, UncertaintyOfTheCalibrationIsNoChange) {
  offset_(2) = 0.05 * kDeg;
  DriftProblem problem = Check(20);
  ASSERT_TRUE(MustCheck(problem).changed);
  const int dq3 = problem.check.FirstInternal() + *model_.parameters.Find("dq3");
  problem.covariance(dq3, dq3) = std::pow(0.05 * kDeg, 2);
  EXPECT_FALSE(MustCheck(problem).changed);
}

// Points show no rotation of the tool: three directions of it, not six.
TEST_F(DriftTest, PointsShowLess) {
  DriftProblem problem = Check(20);
  for (Reading& reading : problem.check.readings) reading.kind = ObservationKind::kPoint;
  const DriftCheckResult result = MustCheck(problem);
  for (const DriftPart& part : result.parts) {
    const int expected = part.name[0] == 'j' ? 1 : part.name[0] == 'b' ? 6 : 3;
    EXPECT_EQ(part.degrees_of_freedom, expected) << part.name;
  }
}

TEST_F(DriftTest, Faults) {
  DriftProblem problem = Check(2);
  auto result = CheckDrift(problem);
  EXPECT_EQ(result.status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(FaultsOf(result.status())[0].field, "readings");
  problem.check.readings.clear();
  problem.covariance.resize(3, 3);
  result = CheckDrift(problem);
  EXPECT_EQ(result.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(FaultsOf(result.status()).size(), 2u);
  Hooks hooks;
  hooks.is_cancelled = [] { return true; };
  EXPECT_EQ(CheckDrift(Check(20), hooks).status().code(), absl::StatusCode::kCancelled);
}

TEST_F(DriftTest, ManyReadingsAreThinned) { EXPECT_EQ(MustCheck(Check(500)).poses, 400); }

// A controller whose joint 3 drags joint 2 along: its offset moves both chain joints.
TEST_F(DriftTest, PartsAreControllerJoints) {
  JointMap map = JointMap::Identity(6);
  map.scale(2, 1) = -1;
  map.scale(4, 5) = 0.5;  // the wrist's last motor turns joint 5 too: no motion of the tool alone
  const Robot coupled = *Robot::Create(robot_.joints(), robot_.chain(), map);
  DriftProblem problem = Check(20);
  problem.robot = &coupled;
  EXPECT_EQ(PartsOf(problem).size(), 7u);
  offset_ = map.scale * Eigen::VectorXd::Unit(6, 1) * 0.05 * kDeg;
  DriftProblem changed = Check(20);
  changed.robot = &coupled;
  EXPECT_EQ(MustCheck(changed).attributed_to, "joint 2");
}

// W (W' W)^-1 = S: against the covariance written out densely.
TEST_F(DriftTest, FieldWhitenerIsOfTheStatedCovariance) {
  DriftProblem problem = Check(4);
  auto& readings = problem.check.readings;
  readings[1].q = readings[0].q + Eigen::VectorXd::Constant(6, 0.05);
  readings[3].q = readings[2].q;
  readings[3].kind = ObservationKind::kPoint;  // another kind: its own field
  const FieldWhitener whitener(problem.check, problem.active, problem.model_error);
  const Eigen::MatrixXd W = whitener.Apply(Eigen::MatrixXd::Identity(21, 21));
  const Eigen::MatrixXd S = (W.transpose() * W).inverse();
  const double rho = FieldCorrelation(0.05 * std::sqrt(6.0), 6);
  EXPECT_NEAR(rho, 0.401, 1e-3);  // (1 - 0.2041)^4
  const double model = kPosition_m / 2;
  // 1e-5: the floor that keeps S regular.
  EXPECT_NEAR(S(0, 0) / (kPosition_m * kPosition_m + model * model), 1, 1e-5);
  EXPECT_NEAR(S(0, 6) / (rho * model * model), 1, 1e-5);
  EXPECT_NEAR(S(5, 11) / (rho * std::pow(kRotation_rad / 2, 2)), 1, 1e-5);
  EXPECT_NEAR(S(0, 7), 0, 1e-20);
  EXPECT_NEAR(S(12, 18), 0, 1e-20);
}

// Positive definite for any poses, also where the plain (1 - d) is not.
TEST(ErrorField, IsACovariance) {
  Random random(3);
  for (int n : {1, 3, 6, 7}) {
    std::vector<Eigen::VectorXd> q;
    for (int i = 0; i < 60; ++i) q.push_back(testing::RandomVector(n, 0.3, &random));
    Eigen::MatrixXd S(60, 60);
    for (int i = 0; i < 60; ++i)
      for (int j = 0; j < 60; ++j) S(i, j) = FieldCorrelation((q[i] - q[j]).norm(), n);
    EXPECT_GT(S.selfadjointView<Eigen::Lower>().eigenvalues().minCoeff(), -1e-12) << n;
  }
}

// The same poses ten times, with an unexplained residual that is the same each time: independent
// readings would make a change of it in most draws. 5 % at most of 60 draws, and 3 sd of luck.
TEST_F(DriftTest, RepeatedPosesAreNotIndependent) {
  int alarms = 0;
  for (int draw = 0; draw < 60; ++draw) {
    DriftProblem problem = Check(8, 0);
    problem.model_error = {2e-4, 4e-4};
    std::vector<Reading>& readings = problem.check.readings;
    for (Reading& reading : readings) {
      reading.X_MT.p += 2e-4 * Normal();
      reading.X_MT.R = ExpRotation<double>(4e-4 * Normal()) * reading.X_MT.R;
    }
    const std::vector<Reading> once = readings;
    for (int repeat = 1; repeat < 10; ++repeat)
      readings.insert(readings.end(), once.begin(), once.end());
    for (Reading& reading : readings) {
      reading.X_MT.p += kPosition_m * Normal();
      reading.X_MT.R = ExpRotation<double>(kRotation_rad * Normal()) * reading.X_MT.R;
    }
    alarms += MustCheck(problem).changed;
  }
  EXPECT_LE(alarms, 8);
}

TEST(DriftTests, ProbabilitiesAreUniformWhenNothingChanged) {
  Random random(5);
  int below = 0;
  for (int draw = 0; draw < 2000; ++draw) {
    DriftSums sums;
    sums.drop_freedom = 16;
    sums.rest_freedom = 104;
    for (int i = 0; i < 16; ++i) sums.drop += std::pow(random.Normal(), 2);
    sums.rest_of_readings = Eigen::VectorXd::Zero(20);
    for (int i = 0; i < 104; ++i) sums.rest_of_readings(i % 20) += std::pow(random.Normal(), 2);
    sums.rest = sums.rest_of_readings.sum();
    below += ChangeProbability(sums) < 0.05;
  }
  // 100 expected, sd 10; the scale of the rest and Bonferroni err to the side of no alarm.
  EXPECT_LE(below, 130);
  EXPECT_GE(below, 40);
}

}  // namespace
}  // namespace truepose
