// Forward(Compensate(X)) == X for every robot: the identified chain at compensated joints is where
// the nominal one would be. Would catch a correction of the wrong sign (which doubles the error), a
// twist at the wrong point, and a Newton that stops early.
#include <gtest/gtest.h>

#include "core/compensation/compensate.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using testing::RandomVector;

Eigen::VectorXd Errors(const Model& model, Random* random) {
  return RandomVector(model.parameters.size(), 2e-3, random);
}

TEST(CompensationLaws, JointTargetsOfRobotsWithSixOrMoreJoints) {
  Random random(21);
  for (const testing::CountedRobot& counted : testing::CountedRobots()) {
    if (counted.robot.joint_count() < 6) continue;
    SCOPED_TRACE(counted.name);
    const Model model = ModifiedIncremental(counted.robot, ModelExtent::kInternal);
    const Eigen::VectorXd lambda = Errors(model, &random),
                          nominal = Eigen::VectorXd::Zero(lambda.size());
    for (int draw = 0; draw < 20; ++draw) {
      // Away from stretched elbows and wrists, where no small correction exists.
      const int n = counted.robot.joint_count();
      const Eigen::VectorXd q = Eigen::VectorXd::Constant(n, 0.9) + RandomVector(n, 0.4, &random);
      const auto solved = CompensateJoints(model, lambda, q, {});
      ASSERT_TRUE(solved.ok()) << solved.status() << " at " << q.transpose();
      const Pose desired = Forward(model.chain, q, nominal),
                 reached = Forward(model.chain, solved->q, lambda);
      EXPECT_LT((desired.p - reached.p).norm(), 1e-12);
      EXPECT_LT((desired.R - reached.R).norm(), 1e-12);
      EXPECT_GT((solved->q - q).norm(), 1e-5) << "errors of 2 mm need a correction";
    }
  }
}

TEST(CompensationLaws, NoErrorNoCorrection) {
  const Robot robot = testing::Ur10();
  const Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(model.parameters.size());
  const Eigen::VectorXd q = (Eigen::VectorXd(6) << 0.1, -1.2, 1.4, -1.7, -1.5, 0.3).finished();
  const auto solved = CompensateJoints(model, zero, q, {});
  ASSERT_TRUE(solved.ok());
  EXPECT_LT((solved->q - q).norm(), 1e-14);
}

// At a stretched elbow a target beyond reach has no answer, and joints must not run away: an error,
// not numbers.
TEST(CompensationLaws, OutOfReachIsAnError) {
  const Robot robot = testing::Ur10();
  const Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(model.parameters.size());
  const Pose far{Eigen::Matrix3d::Identity(), {3, 0, 0}};
  const auto solved = SolvePose(model, zero, far, Eigen::VectorXd::Constant(6, 0.3), {});
  EXPECT_EQ(solved.status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_NE(std::string(solved.status().message()).find("out of reach"), std::string::npos);
}

// A robot of five joints can't correct every error; what remains is least and is told.
TEST(CompensationLaws, FiveJointsReportTheirRemainder) {
  Random random(22);
  const Robot robot = testing::MeasuringArm();
  const Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  const Eigen::VectorXd lambda = Errors(model, &random),
                        nominal = Eigen::VectorXd::Zero(lambda.size());
  const Eigen::VectorXd q = (Eigen::VectorXd(5) << 0.2, 0.5, -0.6, 0.4, 0.7).finished();
  const auto solved = CompensateJoints(model, lambda, q, {});
  ASSERT_TRUE(solved.ok()) << solved.status();
  const Pose desired = Forward(model.chain, q, nominal),
             reached = Forward(model.chain, solved->q, lambda);
  EXPECT_NEAR((desired.p - reached.p).norm(), solved->position_residual_m, 1e-15);
  const Pose uncorrected = Forward(model.chain, q, lambda);
  EXPECT_LT(solved->position_residual_m + solved->rotation_residual_rad,
            (desired.p - uncorrected.p).norm() +
                LogRotation<double>(desired.R * uncorrected.R.transpose()).norm());
}

TEST(CompensationLaws, NominalInverseFindsTheNearestConfiguration) {
  Random random(23);
  const Robot robot = testing::Ur10();
  const Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  const Eigen::VectorXd nominal = Eigen::VectorXd::Zero(model.parameters.size());
  const Eigen::VectorXd home = (Eigen::VectorXd(6) << 0, -1.4, 1.8, -1.9, -1.6, 0).finished();
  for (int draw = 0; draw < 10; ++draw) {
    const Eigen::VectorXd q = home + RandomVector(6, 0.5, &random);
    const auto found = NominalInverse(robot, model, Forward(model.chain, q, nominal), home, {});
    ASSERT_TRUE(found.ok()) << found.status();
    EXPECT_LT((*found - q).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace truepose
