// Pose matching (Secs. 3.2, 3.3): what holds between residuals of poses and of joints.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "compensation/exact.h"
#include "core/compensation/arm_from.h"
#include "core/identification/prediction.h"
#include "core/identification/weights.h"
#include "core/models/model.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

class PoseMatching : public ::testing::Test {
 protected:
  PoseMatching() : model_(ModifiedIncremental(testing::Ur10(), ModelExtent::kInternal)) {
    problem_.model = &model_;
    problem_.placements = problem_.targets = {""};
    Random random(41);
    estimate_ = NominalEstimate(problem_);
    estimate_.X_MB[0] = {ExpRotation<double>({0.2, -0.4, 1.0}), Eigen::Vector3d(1, -2, 0.5)};
    estimate_.X_FT[0] = {ExpRotation<double>({-0.3, 0.1, 0.2}), Eigen::Vector3d(0.05, 0.02, 0.2)};
    estimate_.lambda = testing::RandomVector(model_.parameters.size(), 1e-3, &random);
    reading_.q = testing::RandomVector(6, 1.2, &random);
    reading_.X_MT = Predict(problem_, reading_, estimate_);
    reading_.joint_sd = Eigen::VectorXd::LinSpaced(6, 1e-4, 6e-4);
  }

  // G(S, Lambda): the joints at which the robot with these parameters stands in the reading's pose.
  Eigen::VectorXd Inverse(const Eigen::VectorXd& lambda) const {
    const Pose X_BF =
        truepose::Inverse(estimate_.X_MB[0]) * reading_.X_MT * truepose::Inverse(estimate_.X_FT[0]);
    const auto arm = ArmFrom(testing::Ur10(), model_, lambda);
    EXPECT_TRUE(arm.ok()) << arm.status();
    compensation::ExactOptions options;
    options.position_tolerance_m = options.rotation_tolerance_rad = 1e-14;
    const auto solved = compensation::CorrectPose(*arm, X_BF, reading_.q.data(), options);
    EXPECT_LT(solved.position_error_m + solved.rotation_error_rad, 1e-13);
    return Eigen::Map<const Eigen::VectorXd>(solved.q.data(), 6);
  }

  Model model_;
  Problem problem_;
  Estimate estimate_;
  Reading reading_;
};

// Eq. 9 with its minus (chapter-notes 12): dG/dLambda = -(dF/dQ)^-1 dF/dLambda. As printed the sign
// is the other one, and every identified value would be.
TEST_F(PoseMatching, Equation9HasAMinus) {
  Workspace workspace;
  // Residuals are measured minus predicted: their derivatives are -dF.
  const RowJacobian by_joints = JointJacobian(problem_, reading_, estimate_, &workspace);
  Residual r;
  ReadingJacobian by_parameters;
  EvaluateReading(model_, reading_, PointOf(reading_, estimate_), &workspace, &r, &by_parameters);
  const Eigen::MatrixXd expected =
      -Eigen::MatrixXd(-by_joints).inverse() * Eigen::MatrixXd(-by_parameters.internal);
  const double h = 1e-6;
  for (Eigen::Index k = 0; k < estimate_.lambda.size(); ++k) {
    Eigen::VectorXd plus = estimate_.lambda, minus = estimate_.lambda;
    plus(k) += h;
    minus(k) -= h;
    const Eigen::VectorXd slope = (Inverse(plus) - Inverse(minus)) / (2 * h);
    // Central differences of Newton's 1e-13: 1e-7, and the third derivative times h^2.
    EXPECT_LT((slope - expected.col(k)).cwiseAbs().maxCoeff(), 1e-6 * (1 + slope.norm()))
        << model_.parameters[static_cast<int>(k)].name;
  }
}

// Eq. 8 and the alternative of Fig. 3 are one cost: with R = J_q S_q J_q' the whitened pose
// residual is as long as the joint residual Q_a - G(S, Lambda) in its own deviations.
TEST_F(PoseMatching, BothFormsWeighAlike) {
  const Eigen::VectorXd exact = reading_.q;
  for (uint64_t seed = 1; seed <= 5; ++seed) {
    Random random(seed);
    reading_.q = exact + testing::RandomVector(6, 3e-5, &random);
    const Eigen::VectorXd joint_residual = reading_.q - Inverse(estimate_.lambda);
    const double in_joints = joint_residual.cwiseQuotient(reading_.joint_sd).norm();
    const double in_poses = (WhitenerOf(problem_, reading_, estimate_, {0, 0}) *
                             ResidualAt(problem_, reading_, estimate_))
                                .norm();
    // They differ by the curvature over 0.03 mrad, 2.4e-3 at ten times as much.
    EXPECT_NEAR(in_poses, in_joints, 1e-3 * in_joints);
    reading_.q = exact;
  }
}

}  // namespace
}  // namespace truepose
