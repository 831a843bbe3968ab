// Nominal inverse kinematics: all branches, within limits, nearest, and kept along a path.
#include "compensation/inverse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "compensation/path.h"
#include "compensation/singularity.h"
#include "compensation/turns.h"
#include "tests/compensation/arms.h"
#include "tests/compensation/wrist_arms.h"

namespace truepose::compensation {
namespace {

using truepose::testing::kDeg;
using truepose::testing::NamedArm;
using truepose::testing::RandomVector;

constexpr double kPi = std::numbers::pi;

Arm PumaArm() {
  return truepose::testing::DhWristArm(truepose::testing::PumaRows(), "RRR", 90 * kDeg);
}

double Apart(const JointArray& a, const JointArray& b, int n) {
  double largest = 0;
  for (int i = 0; i < n; ++i)
    largest = std::max(largest, std::abs(std::remainder(a[i] - b[i], 2 * kPi)));
  return largest;
}

// By Newton: a UR10 has up to eight branches, and this place has all.
TEST(Inverse, BranchesOfAnArmWithoutSphericalWrist) {
  const Arm arm = truepose::testing::Ur10Arm(0, 1).arm;
  const JointArray q = {0.3, -1.2, 1.5, -0.7, 1.1, 0.4};
  const Pose X = NominalFlange(arm, q.data());
  const Branches branches = AllBranches(arm, X, q.data(), {});
  EXPECT_FALSE(branches.closed_form);
  EXPECT_EQ(branches.count, 8);
  for (int i = 0; i < branches.count; ++i)
    EXPECT_LT(Remainder(X, NominalFlange(arm, branches.q[i].data())).norm(), 1e-9);
}

TEST(Inverse, NearestBranchStaysAtTheSeed) {
  for (const NamedArm& named : truepose::testing::AllArms()) {
    const int n = named.arm.nominal.joints;
    Random random(95);
    for (int draw = 0; draw < 5; ++draw) {
      const Eigen::VectorXd q = RandomVector(n, 1.2, &random);
      const double length = CharacteristicLength(named.arm.nominal);
      if (SmallestSingularValue(named.arm, q.data(), length) < 0.05) continue;
      const Correction found =
          NearestBranch(named.arm, NominalFlange(named.arm, q.data()), q.data(), {});
      ASSERT_EQ(found.outcome, Outcome::kOk) << named.name;
      for (int i = 0; i < n; ++i) EXPECT_NEAR(found.q[i], q(i), 1e-8) << named.name;
    }
  }
}

// From a seed in another configuration the nearest branch within the limits, not the nearest one.
TEST(Inverse, LimitsChooseTheBranch) {
  Arm arm = PumaArm();
  const JointArray q = {0.4, -0.7, 0.5, 0.6, 0.8, -0.3};
  const Pose X = NominalFlange(arm, q.data());
  arm.limits[4] = {-2, -0.1};  // the flipped wrist only
  const Correction flipped = NearestBranch(arm, X, q.data(), {});
  ASSERT_EQ(flipped.outcome, Outcome::kOk);
  EXPECT_LT(flipped.q[4], -0.1);
  EXPECT_LT(Remainder(X, NominalFlange(arm, flipped.q.data())).norm(), 1e-9);
  arm.limits[4] = {-0.1, 0.1};  // neither
  const Correction neither = NearestBranch(arm, X, q.data(), {});
  EXPECT_EQ(neither.outcome, Outcome::kBeyondLimit);
  EXPECT_EQ(neither.joint, 4);
}

TEST(Inverse, WholeTurnsGoNearTheReferenceOrWithinTheLimits) {
  Arm arm = truepose::testing::Ur10Arm(0, 1).arm;
  JointArray q = {0.3, -1.2, 1.5, -0.7, 1.1, 0.4};
  const JointArray reference = {6, -1.2, 1.5, -0.7, 1.1, 0.4};
  EXPECT_EQ(Unwind(arm, reference.data(), q.data()), -1);
  EXPECT_DOUBLE_EQ(q[0], 0.3);  // 0.3 + 2 pi is beyond the limit of 2 pi
  arm.limits[0] = {-10, 10};
  EXPECT_EQ(Unwind(arm, reference.data(), q.data()), -1);
  EXPECT_DOUBLE_EQ(q[0], 0.3 + 2 * kPi);
  arm.limits[0] = {-3, 0};
  EXPECT_EQ(Unwind(arm, reference.data(), q.data()), 0);
  // A joint that turns another by half of its own turn can't be unwound.
  arm.joint_scale(3, 1) = 0.5;
  EXPECT_FALSE(WholeTurnIsNoMotion(arm, 1));
  EXPECT_TRUE(WholeTurnIsNoMotion(arm, 2));
  arm.nominal.prismatic[4] = true;
  EXPECT_FALSE(WholeTurnIsNoMotion(arm, 4));
}

Pose Shifted(Pose X, const Eigen::Vector3d& by) {
  X.p += by;
  return X;
}

// A straight line, 40 points: the joints move little from point to point and reach every pose.
TEST(Path, KeepsItsConfiguration) {
  const Arm arm = truepose::testing::Ur10Arm(0, 1).arm;
  const JointArray start = {0.3, -1.2, 1.5, -1.7, -1.1, 0.4};
  std::vector<Pose> poses;
  for (int i = 0; i < 40; ++i)
    poses.push_back(Shifted(NominalFlange(arm, start.data()), Eigen::Vector3d(0, 0.01 * i, 0)));
  std::vector<JointArray> q(poses.size());
  const PathEnd end = FollowPath(arm, poses.data(), 40, start.data(), {}, q.data());
  ASSERT_EQ(end.outcome, Outcome::kOk);
  EXPECT_EQ(end.followed, 40);
  EXPECT_GT(end.smallest_singular_value, 1e-3);
  for (int i = 0; i < 40; ++i) {
    EXPECT_LT(Remainder(poses[i], NominalFlange(arm, q[i].data())).norm(), 1e-9);
    EXPECT_LT(Apart(q[i], q[std::max(0, i - 1)], 6), 0.1);
  }
}

// Through a straight wrist: the place is named, and that another wrist would reach the pose beyond.
TEST(Path, MeetsASingularity) {
  const Arm arm = PumaArm();
  JointArray start = {0.4, -0.7, 0.5, 0.6, 0.31, -0.3}, joints = start;
  std::vector<Pose> poses;
  for (int k = 0; k < 32; ++k, joints[4] -= 0.02)
    poses.push_back(NominalFlange(arm, joints.data()));
  std::vector<JointArray> q(poses.size());
  const PathEnd end = FollowPath(arm, poses.data(), 32, start.data(), {}, q.data());
  EXPECT_EQ(end.outcome, Outcome::kNearSingular);
  EXPECT_EQ(end.followed, 16);  // to q5 = 0.01; the next pose stands at -0.01
  EXPECT_NEAR(q[15][4], 0.01, 1e-6);
  EXPECT_LT(end.smallest_singular_value, 5e-3);
  EXPECT_TRUE(end.needs_other_branch);
}

TEST(Path, EndsAtALimitAndOutOfReach) {
  Arm arm = truepose::testing::Ur10Arm(0, 1).arm;
  const JointArray start = {0.3, -1.2, 1.5, -1.7, -1.1, 0.4};
  const Pose X = NominalFlange(arm, start.data());
  const Pose far[] = {X, Shifted(X, {3, 0, 0})};
  JointArray q[2];
  PathEnd end = FollowPath(arm, far, 2, start.data(), {}, q);
  EXPECT_NE(end.outcome, Outcome::kOk);
  EXPECT_FALSE(end.needs_other_branch);
  JointArray turned = start;
  turned[5] += 0.5;
  const Pose turn[] = {X, NominalFlange(arm, turned.data())};
  arm.limits[5] = {-6, 0.7};
  end = FollowPath(arm, turn, 2, start.data(), {}, q);
  EXPECT_EQ(end.outcome, Outcome::kBeyondLimit);
  EXPECT_EQ(end.joint, 5);
  EXPECT_NEAR(end.share, 0.6, 0.01);
  EXPECT_TRUE(end.needs_other_branch);  // a whole turn back is within
  arm.limits[5] = {-1, 0.7};
  arm.limits[4] = {-2, 0};  // nor the flipped wrist
  end = FollowPath(arm, turn, 2, start.data(), {}, q);
  EXPECT_EQ(end.outcome, Outcome::kBeyondLimit);
}

TEST(Path, RefusesWhatIsNoPose) {
  const Arm arm = truepose::testing::Ur10Arm(0, 1).arm;
  const JointArray start = {0.3, -1.2, 1.5, -1.7, -1.1, 0.4};
  Pose bad[2];
  bad[1].p.x() = std::nan("");
  JointArray q[2];
  EXPECT_EQ(FollowPath(arm, bad, 2, start.data(), {}, q).outcome, Outcome::kInvalidArgument);
  EXPECT_EQ(FollowPath(arm, bad, 0, start.data(), {}, q).outcome, Outcome::kInvalidArgument);
}

template <typename... Arguments, typename Result>
constexpr bool IsNoexcept(Result (*)(Arguments...) noexcept) {
  return true;
}
static_assert(IsNoexcept(AllBranches) && IsNoexcept(NearestBranch) && IsNoexcept(FollowPath));

}  // namespace
}  // namespace truepose::compensation
