// Forward(Compensate(X)) == X, for every kind of arm, or a status that says why not.
#include "compensation/exact.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "compensation/effects.h"
#include "compensation/least_squares.h"
#include "compensation/singularity.h"
#include "tests/compensation/arms.h"

namespace truepose::compensation {
namespace {

using truepose::testing::AllArms;
using truepose::testing::NamedArm;
using truepose::testing::RandomVector;
using truepose::testing::Ur10Arm;

// What is asked of exact compensation farther than 1e-3 from a singularity.
constexpr double kExact = 1e-9;

Eigen::VectorXd JointsOf(const NamedArm& named, const Correction& correction) {
  return Eigen::Map<const Eigen::VectorXd>(correction.q.data(), named.robot.joint_count());
}

double SingularValueAt(const Arm& arm, const double* q) {
  return SmallestSingularValue(arm, q, CharacteristicLength(arm.nominal));
}

// What is left by core's Forward of the model, not by the runtime's own: a common mistake would not
// show.
Eigen::Vector2d LeftAt(const NamedArm& named, const Pose& desired, const Correction& correction) {
  const Pose X = Forward(named.model, named.robot.joint_map().ToChain(JointsOf(named, correction)),
                         named.lambda);
  return {(X.p - desired.p).norm(), LogRotation<double>(desired.R * X.R.transpose()).norm()};
}

// Whether damped least squares gets there from any of 200 places within 1 rad of q.
bool CanBeReached(const Arm& arm, const Pose& desired, const Eigen::VectorXd& q, Random* random) {
  LeastSquaresTask task;
  task.arm = &arm;
  task.chain = &arm.identified;
  task.desired = desired;
  for (int start = 0; start < 200; ++start) {
    const Eigen::VectorXd from = q + RandomVector(arm.nominal.joints, 1.0, random);
    if (SolveLeastSquares(task, from.data()).reached) return true;
  }
  return false;
}

// @returns whether a pose that can be reached was said to be unreachable.
bool GaveUpEarly(const NamedArm& named, const Eigen::VectorXd& q, Random* random) {
  const Pose desired = NominalFlange(named.arm, q.data());
  const Correction correction = CorrectJoints(named.arm, q.data(), {});
  const Eigen::Vector2d left = LeftAt(named, desired, correction);
  EXPECT_NEAR(left(0), correction.position_error_m, 1e-12) << named.name;
  EXPECT_NEAR(left(1), correction.rotation_error_rad, 1e-12) << named.name;
  if (correction.outcome == Outcome::kOk) {
    EXPECT_LT(left.maxCoeff(), kExact) << named.name;
  } else if (correction.outcome == Outcome::kNearSingular) {
    // Far from one it may only be another configuration that is meant, and that arrives.
    EXPECT_TRUE(SingularValueAt(named.arm, q.data()) < 1e-3 || left.maxCoeff() < kExact);
  } else {
    EXPECT_EQ(correction.outcome, Outcome::kUnreachable) << named.name;
    return CanBeReached(named.arm, desired, q, random);
  }
  return false;
}

// Also what is said to be unreachable is looked for elsewhere: giving up early would show.
TEST(Exact, SixJointsAndMoreReachWhatTheyCanOrSayWhyNot) {
  int given_up = 0;
  for (const NamedArm& named : AllArms()) {
    if (named.arm.nominal.joints < 6) continue;
    Random random(11);
    for (int draw = 0; draw < 300; ++draw)
      given_up += GaveUpEarly(named, RandomVector(named.arm.nominal.joints, 1.5, &random), &random);
  }
  // Of 2,400 draws: the search is one of 100 starts, and twice as many find more now and then.
  EXPECT_LE(given_up, 1);
}

// Closer and closer to a straight wrist: reached, or said to be singular; joints that ran away are
// never called ok.
TEST(Exact, NearASingularWrist) {
  const NamedArm named = Ur10Arm(1e-3, 3);
  int ok = 0, near = 0;
  for (int exponent = 1; exponent <= 12; ++exponent) {
    for (const double sign : {1.0, -1.0}) {
      const Eigen::VectorXd q =
          (Eigen::VectorXd(6) << 0.3, -1.2, 1.5, -0.7, sign * std::pow(10.0, -0.5 * exponent), 0.4)
              .finished();
      const Pose desired = NominalFlange(named.arm, q.data());
      const Correction correction = CorrectJoints(named.arm, q.data(), {});
      const Eigen::Vector2d left = LeftAt(named, desired, correction);
      const double sigma = SingularValueAt(named.arm, q.data());
      if (correction.outcome == Outcome::kOk) {
        ++ok;
        EXPECT_LT(left.maxCoeff(), kExact);
        // Errors of some 3e-3 move it by 0.1 / 1e-3 times as much at most, where it is so near.
        EXPECT_TRUE(sigma > 1e-3 || (JointsOf(named, correction) - q).norm() < 0.3) << exponent;
      } else {
        ++near;
        EXPECT_LT(sigma, 0.02) << exponent;
      }
    }
  }
  EXPECT_GE(ok, 8);
  EXPECT_GE(near, 8);
}

// A stretched elbow: the identified arm may be shorter than the nominal one. The pose that is left
// is the nearest, so its error is of the size of the errors and no joint has run away.
TEST(Exact, StretchedElbowGivesTheNearestPose) {
  const NamedArm named = Ur10Arm(1e-3, 5);
  int unreached = 0;
  for (int k = 0; k < 20; ++k) {
    const Eigen::VectorXd q =
        (Eigen::VectorXd(6) << 0.1 * k, -0.9, 1e-4, -0.6, 1.2, 0.4).finished();
    const Pose desired = NominalFlange(named.arm, q.data());
    const Correction correction = CorrectJoints(named.arm, q.data(), {});
    if (correction.outcome == Outcome::kOk) continue;
    ++unreached;
    EXPECT_NE(correction.outcome, Outcome::kBeyondLimit);
    EXPECT_LT(correction.position_error_m, 5e-3);
    EXPECT_LT(correction.rotation_error_rad, 5e-3);
    EXPECT_NEAR(LeftAt(named, desired, correction)(0), correction.position_error_m, 1e-12);
  }
  EXPECT_GT(unreached, 0);
}

TEST(Exact, NoErrorsNoChangeEvenAtASingularity) {
  for (const NamedArm& named : AllArms()) {
    Arm arm = named.arm;
    arm.identified = arm.nominal;
    const JointArray home{};
    for (const double q3 : {0.0, 0.7}) {
      JointArray q = home;
      q[std::min(2, arm.nominal.joints - 1)] = q3;
      const Correction correction = CorrectJoints(arm, q.data(), {});
      EXPECT_EQ(correction.outcome, Outcome::kOk) << named.name;
      for (int i = 0; i < arm.nominal.joints; ++i)
        EXPECT_NEAR(correction.q[i], q[i], 1e-12) << named.name;
    }
  }
}

// The chapter's simulated line: about 1 mm before, with the true parameters nothing after.
TEST(Exact, Ur10FromAMillimetreToNothing) {
  const NamedArm named = Ur10Arm(7e-4, 8);
  Random random(21);
  double before = 0, after = 0;
  const int draws = 500;
  for (int draw = 0; draw < draws; ++draw) {
    Eigen::VectorXd q = RandomVector(6, 0.5, &random);
    q += (Eigen::VectorXd(6) << 0, -1.4, 1.8, -1.9, -1.6, 0).finished();
    const Pose desired = NominalFlange(named.arm, q.data());
    before += (IdentifiedFlange(named.arm, q.data()).p - desired.p).squaredNorm() / draws;
    const Correction correction = CorrectJoints(named.arm, q.data(), {});
    ASSERT_EQ(correction.outcome, Outcome::kOk);
    EXPECT_LE(correction.iterations, 3);  // milliradians away: two or three chord steps
    after = std::max(after, LeftAt(named, desired, correction)(0));
  }
  EXPECT_GT(1e3 * std::sqrt(before), 0.8);
  EXPECT_LT(1e3 * std::sqrt(before), 3.0);
  EXPECT_LE(1e3 * after, 1e-6);
}

// Seven joints: what they moved is orthogonal to the null space, so nothing nearer reaches the
// pose.
TEST(Exact, SevenJointsStayNearestToNominal) {
  const NamedArm named =
      truepose::testing::WithErrors("Panda", truepose::testing::Panda(), 3e-3, 4);
  Random random(31);
  for (int draw = 0; draw < 100; ++draw) {
    const Eigen::VectorXd q = RandomVector(7, 1.2, &random);
    const Correction correction = CorrectJoints(named.arm, q.data(), {});
    if (SingularValueAt(named.arm, q.data()) < 0.02) continue;
    ASSERT_EQ(correction.outcome, Outcome::kOk);
    const Eigen::VectorXd moved = JointsOf(named, correction) - q;
    Motions motions;
    SetMotions(named.arm.identified, correction.q.data(), &motions);
    Sweep sweep;
    RunSweep(named.arm.identified, motions, &sweep);
    const Eigen::MatrixXd J = JacobianOf(named.arm.identified, sweep);
    const Eigen::VectorXd null = Eigen::FullPivLU<Eigen::MatrixXd>(J).kernel().col(0).normalized();
    // A step of least change from nominal alone leaves |moved|^2 of it, some 1e-5.
    EXPECT_LT(std::abs(null.dot(moved)), 1e-8) << draw;
  }
}

double WeightedError(const Arm& arm, const Pose& desired, const ExactOptions& options,
                     const Eigen::VectorXd& q) {
  const Pose X = IdentifiedFlange(arm, q.data());
  const Eigen::Vector3d p =
      desired.R.transpose() * (desired * options.point_F - X * options.point_F);
  const Eigen::Vector3d r =
      desired.R.transpose() * LogRotation<double>(desired.R * X.R.transpose());
  Twist e;
  e << p, r;
  return e.cwiseProduct(Eigen::Map<const Twist>(options.weight.data())).norm();
}

// Fewer than six joints: nothing near has a smaller weighted error, at the point and with the
// weights that were asked for.
void ExpectLeast(const NamedArm& named, const ExactOptions& options) {
  Random random(41);
  const int n = named.arm.nominal.joints;
  int refused = 0;
  for (int draw = 0; draw < 20; ++draw) {
    const Eigen::VectorXd q = RandomVector(n, 1.2, &random);
    const Pose desired = NominalFlange(named.arm, q.data());
    const Correction correction = CorrectJoints(named.arm, q.data(), options);
    if (SingularValueAt(named.arm, q.data()) < 0.1) continue;
    if (correction.outcome != Outcome::kOk) {
      ++refused;
      EXPECT_EQ(correction.outcome, Outcome::kNearSingular) << named.name;
      continue;
    }
    const Eigen::VectorXd found = JointsOf(named, correction);
    const double least = WeightedError(named.arm, desired, options, found);
    EXPECT_LE(least, WeightedError(named.arm, desired, options, q)) << named.name;
    for (int k = 0; k < 40; ++k) {
      const Eigen::VectorXd beside = found + RandomVector(n, 1e-3, &random);
      EXPECT_GE(WeightedError(named.arm, desired, options, beside), least * (1 - 1e-9))
          << named.name;
    }
  }
  // Planar arms can trade a millimetre of height for radians: that is refused, seldom.
  EXPECT_LE(refused, 4) << named.name;
}

TEST(Exact, FewerThanSixJointsLeaveTheLeastError) {
  ExactOptions tip;
  tip.point_F = {0.05, -0.02, 0.2};
  ExactOptions uneven;
  uneven.weight = {1, 1, 0.5, 0.2, 0.3, 0.2};
  for (const NamedArm& named : AllArms()) {
    if (named.arm.nominal.joints >= 6) continue;
    ExpectLeast(named, {});
    ExpectLeast(named, tip);
    ExpectLeast(named, uneven);
  }
}

// Position comes first: with five joints the point is met, whatever rotation is left.
TEST(Exact, FiveJointsMeetThePoint) {
  const NamedArm named =
      truepose::testing::WithErrors("5R", truepose::testing::MeasuringArm(), 1e-3, 6);
  const Eigen::VectorXd q = (Eigen::VectorXd(5) << 0.3, 0.7, -0.9, 0.4, 0.8).finished();
  const Correction correction = CorrectJoints(named.arm, q.data(), {});
  ASSERT_EQ(correction.outcome, Outcome::kOk);
  // Rotation weighs 1e-3 m a rad: of 2e-3 rad some 1e-6 of it goes into position.
  EXPECT_LT(correction.position_error_m, 1e-7);
  EXPECT_GT(correction.rotation_error_rad, 1e-5);
  EXPECT_LT(correction.rotation_error_rad, 1e-2);
}

// An effect whose slope is 2 at the target: no readings are found for the joints that are wanted.
// Would catch the target's own joints handed out as corrected.
TEST(Exact, WithoutReadingsFewJointsAreRefused) {
  NamedArm named = truepose::testing::WithErrors("5R", truepose::testing::MeasuringArm(), 1e-3, 6);
  named.arm.effects[1].cosine[1] = 1;
  const Eigen::VectorXd q = (Eigen::VectorXd(5) << 0.3, 0.79, -0.9, 0.4, 0.8).finished();
  JointArray moved{}, readings{};
  MovedJoints(named.arm, q.data(), moved.data());
  ASSERT_FALSE(ReadingsOf(named.arm, moved.data(), readings.data()));
  const Correction correction = CorrectJoints(named.arm, q.data(), {});
  EXPECT_EQ(correction.outcome, Outcome::kNearSingular) << Name(correction.outcome);
}

TEST(Exact, BeyondALimitNamesTheJointAndStaysWithin) {
  NamedArm named = Ur10Arm(1e-3, 9);
  const Eigen::VectorXd q = (Eigen::VectorXd(6) << 0.2, -1.4, 1.8, -1.9, -1.6, 0.3).finished();
  const Correction free = CorrectJoints(named.arm, q.data(), {});
  ASSERT_EQ(free.outcome, Outcome::kOk);
  for (int joint = 0; joint < 6; ++joint) {
    NamedArm limited = named;
    const double away = free.q[joint] - q(joint);
    ASSERT_NE(away, 0);
    // Half of the way is allowed.
    (away > 0 ? limited.arm.limits[joint].upper : limited.arm.limits[joint].lower) =
        q(joint) + 0.5 * away;
    const Correction correction = CorrectJoints(limited.arm, q.data(), {});
    EXPECT_EQ(correction.outcome, Outcome::kBeyondLimit);
    EXPECT_EQ(correction.joint, joint);
    EXPECT_EQ(correction.q[joint], q(joint) + 0.5 * away);
    EXPECT_GT(correction.position_error_m + correction.rotation_error_rad, 1e-6);
    const Pose desired = NominalFlange(named.arm, q.data());
    EXPECT_NEAR(LeftAt(named, desired, correction)(0), correction.position_error_m, 1e-12);
    // The best within: better than the free solution with the joint cut off.
    Correction cut = free;
    cut.q[joint] = correction.q[joint];
    const double length = CharacteristicLength(named.arm.nominal);
    const Eigen::Vector2d left = LeftAt(named, desired, cut);
    EXPECT_LE(std::hypot(correction.position_error_m / length, correction.rotation_error_rad),
              std::hypot(left(0) / length, left(1)) * (1 + 1e-9));
  }
}

// A redundant arm goes round its limit and still arrives.
TEST(Exact, SevenJointsGoRoundALimit) {
  NamedArm named = truepose::testing::WithErrors("Panda", truepose::testing::Panda(), 1e-3, 4);
  const Eigen::VectorXd q = (Eigen::VectorXd(7) << 0.2, 0.4, -0.3, -1.5, 0.5, 1.8, 0.6).finished();
  const Correction free = CorrectJoints(named.arm, q.data(), {});
  ASSERT_EQ(free.outcome, Outcome::kOk);
  const double away = free.q[2] - q(2);
  (away > 0 ? named.arm.limits[2].upper : named.arm.limits[2].lower) = q(2) + 0.5 * away;
  const Correction correction = CorrectJoints(named.arm, q.data(), {});
  EXPECT_EQ(correction.outcome, Outcome::kOk);
  EXPECT_EQ(correction.q[2], q(2) + 0.5 * away);
  EXPECT_LT(LeftAt(named, NominalFlange(named.arm, q.data()), correction).maxCoeff(), kExact);
}

NamedArm CoupledWithEffects() {
  const Robot ur10 = truepose::testing::Ur10();
  JointMap map = JointMap::Identity(6);
  map.scale(2, 1) = 1;
  map.scale(4, 4) = -1;
  map.offset(0) = 0.3;
  const Robot robot = *Robot::Create(ur10.joints(), ur10.chain(), map,
                                     {{1, 9, {0.2, 0.1, 0.3}}, {2, 4, {-0.8, 0, 0.2}}});
  Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  for (EffectGroup group : AllEffectGroups()) AddEffects(robot, group, &model);
  Random random(13);
  Eigen::VectorXd lambda = RandomVector(model.parameters.size(), 1e-3, &random);
  for (const JointEffect& effect : model.effects) {
    if (effect.kind == EffectKind::kTorque) lambda(effect.parameter) *= 1e-2;  // of some 100 N m
  }
  return {"coupled", robot, model, lambda, truepose::testing::ArmOf(robot, model, lambda)};
}

// Effects act on readings, so the solution's readings are looked for again; a map left out shows.
TEST(Exact, CoupledJointsWithEffects) {
  const NamedArm named = CoupledWithEffects();
  Random random(14);
  for (int draw = 0; draw < 50; ++draw) {
    const Eigen::VectorXd q = RandomVector(6, 1.5, &random);
    if (SingularValueAt(named.arm, q.data()) < 0.05) continue;
    const Correction correction = CorrectJoints(named.arm, q.data(), {});
    ASSERT_EQ(correction.outcome, Outcome::kOk) << SingularValueAt(named.arm, q.data());
    EXPECT_LT(LeftAt(named, NominalFlange(named.arm, q.data()), correction).maxCoeff(), kExact);
  }
}

// A pose near a nominal place goes the same way as its joints.
TEST(Exact, PosesAndJointsAgree) {
  for (const NamedArm& named : AllArms()) {
    const int n = named.arm.nominal.joints;
    if (n > 6) continue;  // their null space: the seed is not the nominal solution
    Random random(15);
    for (int draw = 0; draw < 10; ++draw) {
      const Eigen::VectorXd q = RandomVector(n, 1.2, &random);
      if (SingularValueAt(named.arm, q.data()) < 0.05) continue;
      const Correction by_joints = CorrectJoints(named.arm, q.data(), {});
      const Eigen::VectorXd seed = q + RandomVector(n, 0.01, &random);
      const Correction by_pose =
          CorrectPose(named.arm, NominalFlange(named.arm, q.data()), seed.data(), {});
      EXPECT_EQ(by_pose.outcome, by_joints.outcome) << named.name;
      EXPECT_LT((JointsOf(named, by_pose) - JointsOf(named, by_joints)).norm(), 1e-6) << named.name;
    }
  }
}

TEST(Exact, PosesOutOfReachAreSaidSo) {
  const JointArray seed = {0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};
  for (NamedArm& named : AllArms()) {
    for (int i = 0; i < named.arm.nominal.joints; ++i) {
      if (named.arm.nominal.prismatic[i]) named.arm.limits[i] = {-1, 1};
    }
    Pose far = NominalFlange(named.arm, seed.data());
    far.p = {30, 20, 10};
    const Correction correction = CorrectPose(named.arm, far, seed.data(), {});
    // Prismatic joints could go that far but for their limits.
    EXPECT_TRUE(correction.outcome == Outcome::kUnreachable ||
                correction.outcome == Outcome::kBeyondLimit)
        << named.name;
    EXPECT_GT(correction.position_error_m, 1) << named.name;
    for (int i = 0; i < named.arm.nominal.joints; ++i)
      EXPECT_LE(std::abs(correction.q[i]), named.arm.limits[i].upper) << named.name;
  }
}

TEST(Exact, NumbersThatAreNoneAreRefused) {
  const NamedArm named = Ur10Arm(1e-3, 2);
  const JointArray good = {0.2, -1.4, 1.8, -1.9, -1.6, 0.3};
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    for (int i = 0; i < 6; ++i) {
      JointArray q = good;
      q[i] = bad;
      EXPECT_EQ(CorrectJoints(named.arm, q.data(), {}).outcome, Outcome::kInvalidArgument);
      EXPECT_EQ(CorrectPose(named.arm, Pose{}, q.data(), {}).outcome, Outcome::kInvalidArgument);
      EXPECT_EQ(CorrectedTip(named.arm, q.data(), {}, Eigen::Vector3d::UnitZ()).outcome,
                Outcome::kInvalidArgument);
    }
    Pose X;
    X.p.y() = bad;
    EXPECT_EQ(CorrectPose(named.arm, X, good.data(), {}).outcome, Outcome::kInvalidArgument);
    X = Pose{};
    X.R(1, 2) = bad;
    EXPECT_EQ(CorrectPose(named.arm, X, good.data(), {}).outcome, Outcome::kInvalidArgument);
  }
  Pose reflected;
  reflected.R(2, 2) = -1;
  EXPECT_EQ(CorrectPose(named.arm, reflected, good.data(), {}).outcome, Outcome::kInvalidArgument);
  EXPECT_EQ(CorrectJoints(Arm{}, good.data(), {}).outcome, Outcome::kInvalidArgument);
}

// A measuring arm is read, never commanded; its tip is the identified one.
TEST(Exact, MeasuringArmGivesItsTip) {
  NamedArm named =
      truepose::testing::WithErrors("measuring", truepose::testing::MeasuringArm(), 1e-3, 6);
  named.arm.measuring = true;
  const Eigen::VectorXd q = (Eigen::VectorXd(5) << 0.3, 0.7, -0.9, 0.4, 0.8).finished();
  EXPECT_EQ(CorrectJoints(named.arm, q.data(), {}).outcome, Outcome::kInvalidArgument);
  EXPECT_EQ(CorrectPose(named.arm, Pose{}, q.data(), {}).outcome, Outcome::kInvalidArgument);
  const Pose X_FT{ExpRotation<double>({0.1, 0.2, 0.3}), {0.01, 0.02, 0.1}};
  const Eigen::Vector3d axis_T = Eigen::Vector3d(1, 2, 2) / 3;
  const Tip tip = CorrectedTip(named.arm, q.data(), X_FT, axis_T);
  ASSERT_EQ(tip.outcome, Outcome::kOk);
  const Pose X = Forward(named.model, q, named.lambda) * X_FT;
  EXPECT_LT((tip.X_BT.p - X.p).norm() + (tip.X_BT.R - X.R).norm(), 1e-12);
  EXPECT_LT((tip.axis_B - X.R * axis_T).norm(), 1e-12);
}

// Arguments by reference: making them is not what is asked about.
template <typename... Arguments, typename Result>
constexpr bool IsNoexcept(Result (*)(Arguments...) noexcept) {
  return true;
}
static_assert(IsNoexcept(CorrectJoints) && IsNoexcept(CorrectPose) && IsNoexcept(CorrectedTip));

}  // namespace
}  // namespace truepose::compensation
