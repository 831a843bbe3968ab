// Nominal inverse kinematics: all branches, within limits, nearest, and kept along a path.
#include "compensation/inverse.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "compensation/path.h"
#include "compensation/singularity.h"
#include "compensation/spherical_wrist.h"
#include "compensation/trigonometric.h"
#include "compensation/turns.h"
#include "tests/compensation/arms.h"

namespace truepose::compensation {
namespace {

using truepose::testing::kDeg;
using truepose::testing::NamedArm;
using truepose::testing::RandomVector;

constexpr double kPi = std::numbers::pi;

Arm NominalArm(const Robot& robot) { return truepose::testing::WithErrors("", robot, 0, 1).arm; }

// Spherical wrists behind every kind of the first three axes. Rows of D&H: theta, d, a, alpha.
struct Shoulder {
  const char* name;
  std::vector<DhRow> rows;
};

std::vector<Shoulder> Shoulders() {
  const double r = 90 * kDeg;
  return {
      {"Puma: axes 1 and 2 meet", {{0, .67, 0, r}, {0, .15, .43, 0}, {0, 0, .02, -r}}},
      {"KUKA: axis 2 beside axis 1", {{0, .4, .18, -r}, {0, 0, .6, 0}, {-r, 0, .12, -r}}},
      {"axes 1 and 2 parallel", {{0, .3, .4, 0}, {0, .1, .1, r}, {0, 0, .35, -r}}},
      {"nothing at right angles",
       {{.2, .4, .15, 70 * kDeg}, {.1, .1, .5, 25 * kDeg}, {0, .1, .1, -50 * kDeg}}},
      {"elbow without offsets", {{0, .4, 0, r}, {0, 0, .5, 0}, {r, 0, 0, r}}},
      {"axes 1, 2 and 3 meet", {{0, .4, 0, r}, {0, 0, 0, -r}, {0, 0, .4, r}}},
  };
}

Arm WithWrist(std::vector<DhRow> rows, double wrist_angle) {
  rows.push_back({0, .43, 0, wrist_angle});
  rows.push_back({0, 0, 0, -wrist_angle});
  rows.push_back({0, .1, 0, 0});
  return NominalArm(truepose::testing::DhRobot(rows, "RRRRRR"));
}

double Apart(const JointArray& a, const JointArray& b, int n) {
  double largest = 0;
  for (int i = 0; i < n; ++i)
    largest = std::max(largest, std::abs(std::remainder(a[i] - b[i], 2 * kPi)));
  return largest;
}

// What damped Newton finds from 500 seeded places, each once.
std::vector<JointArray> BruteForce(const Arm& arm, const Pose& X) {
  const LeastSquaresTask task = TaskOf(arm, arm.nominal, X, {});
  std::vector<JointArray> found;
  Random random(77);
  for (int start = 0; start < 500; ++start) {
    const Eigen::VectorXd from = RandomVector(6, kPi, &random);
    const LeastSquaresResult solved = SolveLeastSquares(task, from.data());
    if (!solved.reached) continue;
    bool known = false;
    for (const JointArray& q : found) known = known || Apart(q, solved.v, 6) < 1e-5;
    if (!known) found.push_back(solved.v);
  }
  return found;
}

void ExpectAllFound(const Arm& arm, const Pose& X, const JointArray& reference,
                    const std::string& what) {
  const Branches branches = AllBranches(arm, X, reference.data(), {});
  ASSERT_TRUE(branches.closed_form) << what;
  for (int i = 0; i < branches.count; ++i) {
    const Twist e = Remainder(X, NominalFlange(arm, branches.q[i].data()));
    EXPECT_LT(e.norm(), 1e-9) << what;
    for (int k = 0; k < i; ++k) EXPECT_GT(Apart(branches.q[i], branches.q[k], 6), 1e-6) << what;
  }
  for (const JointArray& q : BruteForce(arm, X)) {
    double nearest = 1e9;
    for (int i = 0; i < branches.count; ++i)
      nearest = std::min(nearest, Apart(branches.q[i], q, 6));
    EXPECT_LT(nearest, 1e-5) << what << ", " << branches.count << " branches";
  }
}

// A root lost to a degenerate shoulder, a wrist solution left out, an angle on the wrong side.
TEST(SphericalWrist, FindsAllThatBruteForceFinds) {
  for (const Shoulder& shoulder : Shoulders()) {
    for (const double wrist : {90.0, 60.0}) {
      const Arm arm = WithWrist(shoulder.rows, wrist * kDeg);
      Random random(81);
      for (int draw = 0; draw < 12; ++draw) {
        JointArray q{};
        for (int i = 0; i < 6; ++i) q[i] = random.Uniform(-kPi, kPi);
        if (SmallestSingularValue(arm, q.data(), CharacteristicLength(arm.nominal)) < 1e-2)
          continue;
        ExpectAllFound(arm, NominalFlange(arm, q.data()), q, shoulder.name);
      }
    }
  }
}

TEST(SphericalWrist, EightBranchesOfAPuma) {
  const Arm arm = WithWrist(Shoulders()[0].rows, 90 * kDeg);
  const JointArray q = {0.4, -0.7, 0.5, 0.6, 0.8, -0.3};
  const Branches branches = AllBranches(arm, NominalFlange(arm, q.data()), q.data(), {});
  EXPECT_EQ(branches.count, 8);
  EXPECT_LT(Apart(branches.q[0], q, 6), 1e-9);  // nearest first
}

// Singular places: a straight wrist and a wrist centre over axis 1 leave joints free, which stay
// where the reference is.
TEST(SphericalWrist, FreeJointsStayAtTheReference) {
  const Arm puma = WithWrist(Shoulders()[4].rows, 90 * kDeg);
  const JointArray straight = {0.4, -0.7, 0.5, 0.6, 0, -0.3};
  const Branches wrist =
      AllBranches(puma, NominalFlange(puma, straight.data()), straight.data(), {});
  ASSERT_GE(wrist.count, 1);
  EXPECT_LT(Apart(wrist.q[0], straight, 6), 1e-6);
  // Elbow without offsets: q2 = pi / 2 and q3 = 0 put everything over axis 1.
  const JointArray above = {0.4, kPi / 2, 0, 0.6, 0.9, -0.3};
  const Branches over = AllBranches(puma, NominalFlange(puma, above.data()), above.data(), {});
  ASSERT_GE(over.count, 1);
  EXPECT_LT(Apart(over.q[0], above, 6), 1e-6);
}

TEST(SphericalWrist, WhatIsNoneIsNotTakenForOne) {
  EXPECT_FALSE(SphericalWristOf(NominalArm(truepose::testing::Ur10()).nominal).is_one);
  EXPECT_FALSE(SphericalWristOf(NominalArm(truepose::testing::Panda()).nominal).is_one);
  EXPECT_FALSE(SphericalWristOf(NominalArm(truepose::testing::Stanford()).nominal).is_one);
  // Axes 4, 5, 6 meet but all first three are parallel: never a full reach.
  const std::vector<DhRow> flat = {{0, .3, .4, 0}, {0, .1, .3, 0}, {0, 0, .35, 0}};
  EXPECT_FALSE(SphericalWristOf(WithWrist(flat, 90 * kDeg).nominal).is_one);
  // Off by 0.1 mm: Newton.
  Arm nearly = WithWrist(Shoulders()[0].rows, 90 * kDeg);
  nearly.nominal.constant[5].p.x() += 1e-4;
  EXPECT_FALSE(SphericalWristOf(nearly.nominal).is_one);
}

TEST(Trigonometric, RootsOfProducts) {
  Random random(91);
  for (int draw = 0; draw < 200; ++draw) {
    // (cos(q - a) - cos d)(cos(q - b) - cos e) has the roots a +- d, b +- e.
    const Eigen::VectorXd v = RandomVector(4, 3, &random);
    const auto factor = [](double a, double d) {
      return Trigonometric{-std::cos(d), std::cos(a), std::sin(a), 0, 0};
    };
    const Trigonometric f = factor(v(0), v(2)) * factor(v(1), v(3));
    const Roots roots = RootsOf(f);
    EXPECT_EQ(roots.count, 4);
    for (const double root : {v(0) + v(2), v(0) - v(2), v(1) + v(3), v(1) - v(3)}) {
      double nearest = 1;
      for (int i = 0; i < roots.count; ++i)
        nearest = std::min(nearest, std::abs(std::remainder(roots.q[i] - root, 2 * kPi)));
      EXPECT_LT(nearest, 1e-5) << draw;  // two that nearly merge: the root of the last bits
    }
  }
  EXPECT_EQ(RootsOf(Trigonometric{2, 1, 0, 0, 0}).count, 0);
  EXPECT_EQ(RootsOf(Trigonometric{}).count, 0);
  EXPECT_EQ(RootsOf(Trigonometric{1, 0, 0, 0, 0}).count, 0);
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
  Arm arm = WithWrist(Shoulders()[0].rows, 90 * kDeg);
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
  const Arm arm = WithWrist(Shoulders()[0].rows, 90 * kDeg);
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
