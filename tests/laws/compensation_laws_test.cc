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

// A robot of five joints can't correct every error: position comes first, the remainder is told,
// and no nearby joints are better.
TEST(CompensationLaws, FiveJointsPutPositionFirst) {
  Random random(22);
  const Robot robot = testing::MeasuringArm();
  const Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  const Eigen::VectorXd lambda = Errors(model, &random),
                        nominal = Eigen::VectorXd::Zero(lambda.size());
  const Eigen::VectorXd q = (Eigen::VectorXd(5) << 0.2, 0.5, -0.6, 0.4, 0.7).finished();
  const auto solved = CompensateJoints(model, lambda, q, {});
  ASSERT_TRUE(solved.ok()) << solved.status();
  const Pose desired = Forward(model.chain, q, nominal);
  const auto cost = [&](const Eigen::VectorXd& at) {
    const Pose X = Forward(model.chain, at, lambda);
    return (desired.p - X.p).squaredNorm() +
           1e-6 * LogRotation<double>(desired.R * X.R.transpose()).squaredNorm();
  };
  EXPECT_NEAR((desired.p - Forward(model.chain, solved->q, lambda).p).norm(),
              solved->position_residual_m, 1e-15);
  EXPECT_LT(solved->position_residual_m, 2e-5);
  EXPECT_GT((desired.p - Forward(model.chain, q, lambda).p).norm(), 3e-4);
  for (int draw = 0; draw < 50; ++draw) {
    EXPECT_LE(cost(solved->q), cost(solved->q + RandomVector(5, 1e-4, &random)));
  }
}

// A joint map in which a turn of the controller's joint is no turn of the chain: pose targets still
// land where they should.
TEST(CompensationLaws, NominalInverseWithACoupledMap) {
  const Robot plain = testing::Ur10();
  JointMap map = JointMap::Identity(6);
  map.scale(0, 0) = 0.5;
  map.scale(2, 1) = 1;
  const auto robot = Robot::Create(plain.joints(), plain.chain(), map);
  ASSERT_TRUE(robot.ok());
  const Model model = ModifiedIncremental(*robot, ModelExtent::kInternal);
  const Eigen::VectorXd nominal = Eigen::VectorXd::Zero(model.parameters.size());
  Random random(24);
  for (int draw = 0; draw < 20; ++draw) {
    const Pose X_BF = Forward(
        model.chain, Eigen::VectorXd::Constant(6, 0.9) + RandomVector(6, 0.5, &random), nominal);
    const auto found = NominalInverse(*robot, model, X_BF, Eigen::VectorXd::Constant(6, 5.0), {});
    ASSERT_TRUE(found.ok()) << found.status();
    EXPECT_LT((Forward(model.chain, *found, nominal).p - X_BF.p).norm(), 1e-9);
  }
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
