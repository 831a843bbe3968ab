// What a node of a table holds.
#include "core/compensation/correction_twist.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/core/compensation/drawn_arm.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using compensation::Arm;
using testing::DrawnArm;

// Would catch a twist in another frame or of another order than compensation/table.h states: with
// it, X_BL E Z_n C[n] must be the identified flange.
TEST(CorrectionTwist, GivesTheIdentifiedFlange) {
  Random random(1);
  for (const Robot& robot : {testing::Ur10(), testing::Panda(), testing::Stanford(),
                             testing::Scara(), testing::MeasuringArm()}) {
    const Arm arm = DrawnArm(robot, 7);
    for (int i = 0; i < 20; ++i) {
      const Eigen::VectorXd q = testing::RandomVector(robot.joint_count(), 1.5, &random);
      const Twist twist = CorrectionTwist(arm, q.data());
      const int n = robot.joint_count();
      Pose last;  // Z_n
      if (arm.nominal.prismatic[n - 1])
        last.p.z() = q(n - 1);
      else
        last.R = Eigen::AngleAxisd(q(n - 1), Eigen::Vector3d::UnitZ()).toRotationMatrix();
      const Pose X_LF = last * arm.nominal.constant[n];
      const Pose X_BL = compensation::NominalFlange(arm, q.data()) * Inverse(X_LF);
      const Pose E{ExpRotation<double>(twist.tail<3>()), twist.head<3>()};
      const Twist left =
          compensation::Remainder(compensation::IdentifiedFlange(arm, q.data()), X_BL * E * X_LF);
      EXPECT_LT(left.norm(), 1e-14);  // some twenty products of numbers of 1
    }
  }
}

// The gauge: would catch a frame in which the first or the last joint matters, which would make
// tables a hundred times as large.
TEST(CorrectionTwist, DoesNotDependOnTheFirstAndLastJoint) {
  const Arm arm = DrawnArm(testing::Ur10(), 3);
  Random random(2);
  for (int i = 0; i < 20; ++i) {
    Eigen::VectorXd q = testing::RandomVector(6, 3, &random);
    const Twist here = CorrectionTwist(arm, q.data());
    q(0) = random.Uniform(-3, 3);
    q(5) = random.Uniform(-3, 3);
    EXPECT_LT((CorrectionTwist(arm, q.data()) - here).norm(), 1e-14);
    q(1) += 0.5;
    EXPECT_GT((CorrectionTwist(arm, q.data()) - here).norm(), 1e-6);
  }
}

// Would catch a rotation that does not act on the flange's lever.
TEST(CorrectionTwist, MovesTheFlangeAsItSays) {
  const Arm arm = DrawnArm(testing::Stanford(), 5);
  const Eigen::VectorXd q = Eigen::VectorXd::Constant(6, 0.4);
  const Twist motion = FlangeMotion(CorrectionTwist(arm, q.data()), FlangeInL(arm, q(5)));
  const Twist between = compensation::Remainder(compensation::IdentifiedFlange(arm, q.data()),
                                                compensation::NominalFlange(arm, q.data()));
  // Second order of 1e-3 rad at a lever of 0.3 m.
  EXPECT_NEAR(motion.head<3>().norm(), between.head<3>().norm(), 3e-7);
  EXPECT_NEAR(motion.tail<3>().norm(), between.tail<3>().norm(), 1e-12);
}

}  // namespace
}  // namespace truepose
