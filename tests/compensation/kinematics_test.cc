// Derivatives, curvature and small steps of a chain, against differences.
#include "compensation/kinematics.h"

#include <gtest/gtest.h>

#include "compensation/effects.h"
#include "compensation/singularity.h"
#include "tests/compensation/arms.h"

namespace truepose::compensation {
namespace {

using truepose::testing::NamedArm;
using truepose::testing::RandomVector;

Sweep SweepAt(const JointChain& chain, const Eigen::VectorXd& q) {
  Motions motions;
  SetMotions(chain, q.data(), &motions);
  Sweep sweep;
  RunSweep(chain, motions, &sweep);
  return sweep;
}

TEST(Kinematics, JacobianAndCurvatureAreThoseOfDifferences) {
  for (const NamedArm& named : truepose::testing::AllArms()) {
    const JointChain& chain = named.arm.identified;
    Random random(51);
    const Eigen::VectorXd q = RandomVector(chain.joints, 1.5, &random);
    const Eigen::VectorXd step = RandomVector(chain.joints, 1.0, &random);
    const Sweep sweep = SweepAt(chain, q);
    EXPECT_LT((sweep.X_BF.p - Forward(chain, q.data()).p).norm(), 1e-15);
    const double h = 1e-3;
    const Eigen::VectorXd plus_q = q + h * step, minus_q = q - h * step;
    const Twist plus = Remainder(Forward(chain, plus_q.data()), sweep.X_BF);
    const Twist minus = Remainder(Forward(chain, minus_q.data()), sweep.X_BF);
    const Jacobian J = JacobianOf(chain, sweep);
    // The next terms are of order h^2 in the first, h^2 in the second difference quotient.
    EXPECT_LT((J * step - (plus - minus) / (2 * h)).norm(), 1e-4) << named.name;
    EXPECT_LT((Curvature(chain, sweep, step.data()) - (plus + minus) / (2 * h * h)).norm(), 1e-4)
        << named.name;
  }
}

// Twenty of the longest small steps: a lost term of the series is 1e-12 a step at least.
TEST(Kinematics, SmallStepsAreSines) {
  const NamedArm named =
      truepose::testing::WithErrors("Stanford", truepose::testing::Stanford(), 1e-3, 1);
  Eigen::VectorXd q = Eigen::VectorXd::LinSpaced(6, -3, 3);
  const Eigen::VectorXd step = Eigen::VectorXd::Constant(6, kLongestSmallStep);
  Motions motions;
  SetMotions(named.arm.nominal, q.data(), &motions);
  for (int k = 0; k < 20; ++k) AddSmallStep(named.arm.nominal, step.data(), &motions);
  q += 20 * step;
  Motions exact;
  SetMotions(named.arm.nominal, q.data(), &exact);
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(motions[i].cosine, exact[i].cosine, 5e-14) << i;
    EXPECT_NEAR(motions[i].sine, exact[i].sine, 5e-14) << i;
  }
}

// The series and the logarithm agree where one hands over to the other, and at half a turn.
TEST(Kinematics, RemainderOfEveryAngle) {
  const Eigen::Vector3d axis = Eigen::Vector3d(1, -2, 2) / 3;
  const Pose X{ExpRotation<double>({0.4, 0.5, -0.6}), {1, 2, 3}};
  for (const double angle : {0.0, 1e-12, 1e-6, 1e-3, 0.0199, 0.0201, 0.5, 3.0, 3.14}) {
    const Pose desired{ExpRotation<double>(angle * axis) * X.R, {1, 2, 3.5}};
    const Twist e = Remainder(desired, X);
    EXPECT_LT((e.tail<3>() - angle * axis).norm(), 1e-13) << angle;
    EXPECT_LT((e.head<3>() - Eigen::Vector3d(0, 0, 0.5)).norm(), 1e-15);
  }
}

// Lengths over the characteristic length: a robot twice as large is as far from its singularities.
TEST(Singularity, DoesNotDependOnTheRobotsSize) {
  for (const NamedArm& named : truepose::testing::AllArms()) {
    Arm large = named.arm;
    for (Pose& X : large.nominal.constant) X.p *= 2;
    const int n = named.arm.nominal.joints;
    Random random(71);
    Eigen::VectorXd q = RandomVector(n, 1.5, &random), twice = q;
    for (int i = 0; i < n; ++i) twice(i) *= named.arm.nominal.prismatic[i] ? 2 : 1;
    const double length = CharacteristicLength(named.arm.nominal);
    if (length == 1) continue;  // all frames in one place
    EXPECT_NEAR(CharacteristicLength(large.nominal), 2 * length, 1e-12);
    EXPECT_NEAR(SmallestSingularValue(large, twice.data(), 2 * length),
                SmallestSingularValue(named.arm, q.data(), length), 1e-7)
        << named.name;
  }
}

TEST(Singularity, IsZeroAtAStraightWrist) {
  const NamedArm named = truepose::testing::Ur10Arm(0, 1);
  const double length = CharacteristicLength(named.arm.nominal);
  const JointArray straight = {0.3, -1.2, 1.5, -0.7, 0, 0.4}, bent = {0.3, -1.2, 1.5, -0.7, 1, 0.4};
  EXPECT_LT(SmallestSingularValue(named.arm, straight.data(), length), 1e-7);
  EXPECT_GT(SmallestSingularValue(named.arm, bent.data(), length), 0.05);
}

// Readings and moved joints are inverse to one another; what does not settle says so.
TEST(Effects, ReadingsAreTheInverseOfMovedJoints) {
  NamedArm named = truepose::testing::Ur10Arm(0, 1);
  for (int i = 0; i < 6; ++i) named.arm.effects[i] = {0.01, {3e-3, 1e-3}, {-2e-3, 2e-3}, 2e-6};
  named.arm.masses = 1;
  named.arm.mass[0] = {2, 20, {-0.5, 0, 0.3}};
  const JointArray q = {0.3, -1.2, 1.5, -0.7, 2, 6};
  JointArray moved, back;
  MovedJoints(named.arm, q.data(), moved.data());
  ASSERT_TRUE(ReadingsOf(named.arm, moved.data(), back.data()));
  for (int i = 0; i < 6; ++i) {
    EXPECT_GT(std::abs(moved[i] - q[i]), 1e-5);
    EXPECT_NEAR(back[i], q[i], 1e-14);
  }
  named.arm.effects[0].gain = -3;
  EXPECT_FALSE(ReadingsOf(named.arm, moved.data(), back.data()));
}

}  // namespace
}  // namespace truepose::compensation
