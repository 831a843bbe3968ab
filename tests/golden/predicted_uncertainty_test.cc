// Predicted uncertainty is right (experiments E6): a new UR10, new noise of instrument and joints
// in each session. The joints' noise is stated, the instrument's is found by the weights. What the
// parameters alone leave is looked at where nothing is measured: at check poses without noise, in
// the frames that were identified. And what it is all for: the same of a tool that is sent there by
// corrected joints, so that the true robot goes where the identified one would.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <iostream>
#include <optional>

#include "compensation/exact.h"
#include "core/assessment/accuracy.h"
#include "core/base/chi_square.h"
#include "core/compensation/arm_from.h"
#include "core/identification/prediction.h"
#include "tests/core/testing/robots.h"
#include "tests/core/testing/simulated.h"
#include "tests/golden/long_run.h"

namespace truepose {
namespace {

constexpr int kPoses = 60, kChecks = 40;
constexpr double kPositionNoise_m = 5e-5, kRotationNoise_rad = 1e-4, kJointNoise_rad = 2e-4;

// What is made of a session: noise of the joints as stated, and of the instrument if not found.
struct Weighing {
  double joint_sd = kJointNoise_rad;
  IdentifyOptions options = Coarse();

  // s_model to a thousandth: finer moves no ratio that is looked at here.
  static IdentifyOptions Coarse() {
    IdentifyOptions options;
    options.weight_tolerance = 1e-3;
    return options;
  }
};

SimulateOptions Design(uint64_t seed) {
  SimulateOptions options;
  options.poses = kPoses + kChecks;
  options.seed = seed;
  options.position_noise_sd_m = kPositionNoise_m;
  options.rotation_noise_sd_rad = kRotationNoise_rad;
  options.joint_noise_sd = kJointNoise_rad;
  return options;
}

// One session: the first kPoses readings calibrate, the others are control readings with noise
// like theirs.
class Session {
 public:
  Session(uint64_t seed, double joint_sd)
      : simulated_(testing::Ur10(), testing::AnyTarget(), Design(seed)) {
    calibration.model = control.model = checks.model = &simulated_.model();
    for (Problem* part : {&calibration, &control, &checks}) part->placements = part->targets = {""};
    for (Reading& reading : simulated_.Problem().readings) Distribute(joint_sd, &reading);
  }

  const Robot& robot() const { return simulated_.robot(); }

  // Where the true robot's target is at joints that it is commanded to.
  Pose TruePose(const Eigen::VectorXd& q) const {
    const SimulatedSession& truth = simulated_.session();
    return truth.X_MB * Forward(simulated_.model(), q, truth.lambda) * truth.X_FT;
  }

  // True frames, nominal parameters.
  Estimate Start() const {
    return {{simulated_.session().X_MB},
            {simulated_.session().X_FT},
            Eigen::VectorXd::Zero(simulated_.model().parameters.size())};
  }

  Problem calibration, control;
  Problem checks;  // the true robot's poses at the joints of the control readings

 private:
  void Distribute(double joint_sd, Reading* reading) {
    if (joint_sd > 0) reading->joint_sd = Eigen::VectorXd::Constant(6, joint_sd);
    (reading->id < kPoses ? calibration : control).readings.push_back(*reading);
    if (reading->id < kPoses) return;
    reading->X_MT = TruePose(reading->q);
    checks.readings.push_back(*reading);
  }

  testing::Simulated simulated_;
};

Identification Identified(const Session& session, const IdentifyOptions& options) {
  const auto before = FitFrames(session.calibration, session.Start(), options, {});
  EXPECT_TRUE(before.ok()) << before.status();
  const auto result =
      Identify(session.calibration, GenericIdentifiable(session.calibration, session.robot()),
               *before, options, {});
  EXPECT_TRUE(result.ok()) << result.status();
  EXPECT_EQ(result->set.active.size(), 30u);
  return *result;
}

// Over sessions: roots of the mean ratios of true and predicted mean squares, shares inside.
struct Found {
  double parameters = 0;          // check poses by J C J'
  double inside = 0;              // check poses inside their 95 % region by J C J'
  double compensated = 0;         // targets sent to by corrected joints, by J C J'
  double compensated_inside = 0;  // of them inside their region
  int sent = 0;                   // of them, to where the identified robot can go
  double control = 0;             // control readings by all that is predicted
  double control_inside = 0;      // of them inside their region
};

// Derivatives of the position by the active candidates.
Eigen::MatrixXd PositionJacobian(const Problem& problem, const Reading& reading,
                                 const Identification& result) {
  Workspace workspace;
  Residual r;
  ReadingJacobian J;
  EvaluateReading(*problem.model, reading, PointOf(reading, result.estimate), &workspace, &r, &J);
  Eigen::MatrixXd all(3, problem.CandidateCount());
  all << J.base.topRows(3), J.tool.topRows(3), J.internal.topRows(3);
  return all(Eigen::all, result.set.active);
}

void AddChecks(const Problem& checks, const Identification& result, Found* found) {
  double true_square = 0, predicted_square = 0;
  for (const Reading& reading : checks.readings) {
    const Eigen::MatrixXd J = PositionJacobian(checks, reading, result);
    const Eigen::Matrix3d S = J * result.covariance * J.transpose();
    const Eigen::Vector3d r = ResidualAt(checks, reading, result.estimate).head<3>();
    found->inside += r.dot(S.ldlt().solve(r)) <= ChiSquareQuantile(0.95, 3);
    true_square += r.squaredNorm();
    predicted_square += S.trace();
  }
  found->parameters += true_square / predicted_square;
}

// A target at the pose that the nominal robot would have at the check's joints. None where the
// identified robot can't go: a UR10 that is stretched out further than its links are found to be.
struct Sent {
  Reading reading;       // the corrected joints, and where they took the true target
  Eigen::Vector3d miss;  // from where it was sent
};

std::optional<Sent> SendTo(const Session& session, const compensation::Arm& arm,
                           const Reading& check, const Identification& result) {
  Sent sent{check, {}};
  const compensation::Correction corrected = compensation::CorrectJoints(arm, check.q.data(), {});
  if (corrected.outcome != compensation::Outcome::kOk) return std::nullopt;
  sent.reading.q = Eigen::Map<const Eigen::VectorXd>(corrected.q.data(), check.q.size());
  sent.reading.X_MT = session.TruePose(sent.reading.q);
  const Pose desired = result.estimate.X_MB[0] * compensation::NominalFlange(arm, check.q.data()) *
                       result.estimate.X_FT[0];
  sent.miss = sent.reading.X_MT.p - desired.p;
  return sent;
}

void AddCompensated(const Session& session, const Identification& result, Found* found) {
  const auto arm = ArmFrom(session.robot(), *session.checks.model, result.estimate.lambda);
  ASSERT_TRUE(arm.ok()) << arm.status();
  double true_square = 0, predicted_square = 0;
  for (const Reading& check : session.checks.readings) {
    const auto sent = SendTo(session, *arm, check, result);
    if (!sent) continue;
    ++found->sent;
    const Eigen::MatrixXd J = PositionJacobian(session.checks, sent->reading, result);
    const Eigen::Matrix3d S = J * result.covariance * J.transpose();
    // The residual is in the frame that S is in.
    const Eigen::Vector3d r = ResidualAt(session.checks, sent->reading, result.estimate).head<3>();
    EXPECT_NEAR(r.norm(), sent->miss.norm(), 1e-9);  // what exact correction leaves
    found->compensated_inside += r.dot(S.ldlt().solve(r)) <= ChiSquareQuantile(0.95, 3);
    true_square += sent->miss.squaredNorm();
    predicted_square += S.trace();
  }
  found->compensated += true_square / predicted_square;
}

void AddControl(const Session& session, const Identification& result, Found* found) {
  const PredictedAccuracy predicted = Predicted(session.control, session.calibration, result);
  const PoseStatistics control = PoseStatisticsOf(PoseErrors(session.control, result.estimate));
  found->control += std::pow(control.position_m.rms / predicted.position_rms_m, 2);
  found->control_inside += predicted.inside;
}

Found Over(int sessions, const Weighing& weighing) {
  Found found;
  for (int seed = 1; seed <= sessions; ++seed) {
    const Session session(static_cast<uint64_t>(seed), weighing.joint_sd);
    const Identification result = Identified(session, weighing.options);
    AddChecks(session.checks, result, &found);
    AddCompensated(session, result, &found);
    AddControl(session, result, &found);
  }
  found.parameters = std::sqrt(found.parameters / sessions);
  found.compensated = std::sqrt(found.compensated / sessions);
  found.compensated_inside /= found.sent;
  found.control = std::sqrt(found.control / sessions);
  found.inside /= kChecks * sessions;
  found.control_inside /= kChecks * sessions;
  std::cout << sessions << " sessions: check poses " << found.parameters << " of the prediction, "
            << 100 * found.inside << " % inside; compensated tool " << found.compensated << ", "
            << 100 * found.compensated_inside << " % of " << found.sent << "; control readings "
            << found.control << ", " << 100 * found.control_inside << " %\n";
  return found;
}

// Of one session the ratio of squares has a relative deviation of 0.4, since a few directions make
// most of it: the root of the mean has a standard error of 0.014 of 200 sessions and 0.03 of 40,
// where 0.1 is three of them; shares inside go with it. 200 sessions measured 0.977 and 96.1 %, and
// 1.002 and 95.3 % of control readings. s_model can't be below zero, so the prediction is on the
// safe side where the joints' noise is most of it: with all noise known, 1,000 sessions measured
// 0.992 (0.007) and 95.4 %.
TEST(PredictedUncertainty, IsThatOfNewRobots) {
  const int sessions = testing::Draws(40, 200);
  const Found found = Over(sessions, {});
  EXPECT_NEAR(found.parameters, 1, sessions < 200 ? 0.1 : 0.05);
  EXPECT_NEAR(found.inside, 0.95, sessions < 200 ? 0.04 : 0.02);
  // The corrected joints lie so near that ratio and share are those of the check poses.
  EXPECT_GT(found.sent, 0.95 * kChecks * sessions);
  EXPECT_NEAR(found.compensated, 1, sessions < 200 ? 0.1 : 0.05);
  EXPECT_NEAR(found.compensated_inside, 0.95, sessions < 200 ? 0.04 : 0.02);
  EXPECT_NEAR(found.control, 1, 0.05);
  EXPECT_NEAR(found.control_inside, 0.95, 0.02);
}

// The negative control: noise of the joints left out of R and nothing in its place. Would catch a
// test that nothing can fail. 200 sessions measured 3.69 and 10.7 %.
TEST(PredictedUncertainty, FailsWithoutTheJoints) {
  Weighing weighing;
  weighing.joint_sd = 0;
  weighing.options.known_model_error = ModelError{kPositionNoise_m, kRotationNoise_rad};
  const Found found = Over(testing::Draws(10, 200), weighing);
  EXPECT_GT(found.parameters, 1.2);
  EXPECT_GT(found.compensated, 1.2);
  EXPECT_LT(found.compensated_inside, 0.9);
  EXPECT_LT(found.inside, 0.9);
}

}  // namespace
}  // namespace truepose
