#include "compensation/correct_by_table.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "compensation/singularity.h"
#include "compensation/table_motion.h"
#include "core/base/random.h"
#include "tests/compensation/table_samples.h"

namespace truepose::compensation {
namespace {

// Poses are products of some dozen matrices of numbers below 2.
constexpr double kRounding = 1e-13;
// A lookup rounds weights and sums to float, 6e-8 at a time: of the correction, whose rotation
// moves the flange by about 1 m, and the last step of joints may change what is rounded.
constexpr double kRoundedLookup = 5e-7;

// As fine as a table that is used: errors of about 1 mm leave some hundredths.
const TableContent& FineContent() {
  static const TableContent* content = [] {
    auto* made = new TableContent(testing::Ur10Content(testing::Ur10Arm(3e-4), {20, 20, 8, 8}));
    testing::FillNodes(made);
    return made;
  }();
  return *content;
}

// In the domain, and far enough from singularities to be corrected.
JointArray RandomTarget(const TableContent& content, Random* random) {
  const TableHeader& header = content.header;
  JointArray q;
  do {
    std::vector<double> u;
    for (int i = 0; i < header.joints; ++i)
      u.push_back(random->Uniform(content.axis[i].lower, content.axis[i].upper));
    q = testing::JointsAt(content, u);
  } while (SmallestSingularValue(content.arm, q.data(), header.characteristic_length_m) <
           header.smallest_singular_value);
  return q;
}

Twist Between(const Pose& desired, const Pose& reached) { return Remainder(desired, reached); }

// What is left at corrected joints, by poses that the tests make for themselves.
Twist LeftByTable(const Table& table, const JointArray& target, const Correction& correction) {
  JointArray from, to;
  ChainJoints(table, target.data(), from.data());
  ChainJoints(table, correction.q.data(), to.data());
  return Between(Forward(table.arm.nominal, from.data()), testing::FlangeByTable(table, to.data()));
}

// The law: corrected joints bring the table's flange to where the nominal one is, and what is
// reported as left is at least what is left, also where the last step was not looked at.
void ExpectCorrected(const Table& table, const JointArray& target) {
  const Correction correction = CorrectByTable(table, target.data());
  ASSERT_EQ(correction.outcome, Outcome::kOk)
      << Name(correction.outcome) << " " << correction.joint;
  const Twist left = LeftByTable(table, target, correction);
  JointArray q_chain;
  ChainJoints(table, target.data(), q_chain.data());
  const double rounding =
      kRoundedLookup * LookUp(table, q_chain.data(), Reach::kDomain).delta.norm();
  const PoseError& asked = table.header.tolerance;
  EXPECT_LE(correction.position_error_m, std::max(1e-9, 1e-3 * asked.position_m) + rounding);
  EXPECT_LE(correction.rotation_error_rad, std::max(1e-9, 1e-3 * asked.rotation_rad) + rounding);
  EXPECT_LE(left.head<3>().norm(), correction.position_error_m + rounding);
  EXPECT_LE(left.tail<3>().norm(), correction.rotation_error_rad + rounding);
}

TEST(CorrectByTable, BringsTheTablesFlangeToTheTarget) {
  Random random(21);
  const Table table = MakeTable(FineContent());
  for (int trial = 0; trial < 300; ++trial)
    ExpectCorrected(table, RandomTarget(FineContent(), &random));
}

// A table that was asked for little error is solved finer, and not finer than its numbers are.
TEST(CorrectByTable, IsSolvedToAThousandthOfTheTolerance) {
  Random random(24);
  TableContent content = FineContent();
  for (const double asked : {0.0, 1e-6, 1e-4}) {
    content.header.tolerance = {asked, asked};
    const Table table = MakeTable(content);
    for (int trial = 0; trial < 100; ++trial)
      ExpectCorrected(table, RandomTarget(content, &random));
  }
}

// Would catch a last step called nothing because the one before happened to leave little: on a
// coarse grid, or where the tolerance of rotation is far looser than that of position or the other
// way round, what a step leaves in one comes out of the other.
TEST(CorrectByTable, NeverLeavesMoreThanItSays) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    std::vector<bool> prismatic(6, false);
    if (seed % 3 != 0) prismatic[seed % 6] = true;
    TableContent content = testing::PlainContent(testing::RandomArm(prismatic, 2e-3, seed), 0.2);
    for (const PoseError& asked : {PoseError{1e-4, 1e-3}, {2e-5, 1e-2}, {1e-3, 1e-6}}) {
      content.header.tolerance = asked;
      const Table table = MakeTable(content);
      Random random(seed);
      for (int trial = 0; trial < 60; ++trial) {
        const JointArray target = RandomTarget(content, &random);
        if (CorrectByTable(table, target.data()).outcome == Outcome::kOk)
          ExpectCorrected(table, target);
      }
    }
  }
}

// The table holds the correction of the flange in the right frame and with the right sign: the
// identified flange comes to the target as near as the nodes are dense.
TEST(CorrectByTable, BringsTheIdentifiedFlangeToTheTarget) {
  Random random(22);
  const Table table = MakeTable(FineContent());
  double before = 0, after = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const JointArray q = RandomTarget(FineContent(), &random);
    const Pose desired = NominalFlange(table.arm, q.data());
    const Correction correction = CorrectByTable(table, q.data());
    ASSERT_EQ(correction.outcome, Outcome::kOk);
    const Pose reached = IdentifiedFlange(table.arm, correction.q.data());
    before = std::max(before, (IdentifiedFlange(table.arm, q.data()).p - desired.p).norm());
    after = std::max(after, (reached.p - desired.p).norm());
  }
  EXPECT_GT(before, 5e-4);
  EXPECT_LT(after, before / 50) << "20 nodes a radian leave 1 / 400 of the curvature";
}

// Large errors ask for long steps, which the fast way leaves to the slow one: both meet the law.
TEST(CorrectByTable, CorrectsLargeErrorsToo) {
  TableContent content = testing::Ur10Content(testing::Ur10Arm(2e-2), {4, 4, 3, 3});
  for (int i = 1; i < 5; ++i) content.axis[i].margin = 0.5;
  for (JointLimits& limits : content.arm.limits) limits = {};
  content.header.smallest_singular_value = 0.1;  // nearer, 5 cm may be out of reach
  testing::FillNodes(&content);
  const Table table = MakeTable(content);
  Random random(23);
  for (int trial = 0; trial < 50; ++trial) ExpectCorrected(table, RandomTarget(content, &random));
}

// Arms of other kinds: prismatic joints first, among others and last.
TEST(CorrectByTable, CorrectsArmsWithSlidingJoints) {
  const std::vector<bool> kinds[] = {{true, false, false, false, false, false},
                                     {false, false, true, false, false, false},
                                     {false, false, false, false, false, true}};
  for (const std::vector<bool>& prismatic : kinds) {
    const TableContent content = testing::PlainContent(testing::RandomArm(prismatic, 1e-3, 2), 0.2);
    const Table table = MakeTable(content);
    Random random(24);
    for (int trial = 0; trial < 30; ++trial) ExpectCorrected(table, RandomTarget(content, &random));
  }
}

// The direction in which seven joints move without moving the nominal flange.
Eigen::VectorXd NullDirection(const Arm& arm, const JointArray& q) {
  Motions motions;
  SetMotions(arm.nominal, q.data(), &motions);
  Sweep sweep;
  RunSweep(arm.nominal, motions, &sweep);
  const Eigen::MatrixXd J = JacobianOf(arm.nominal, sweep);
  return J.fullPivLu().kernel().col(0).normalized();
}

// Seven and more joints: reached, and of all joints that reach the pose the nearest, so the change
// has no part along the null space.
TEST(CorrectByTable, StaysNearestWithSevenJoints) {
  const TableContent content =
      testing::PlainContent(testing::RandomArm(std::vector<bool>(7, false), 1e-3, 4), 0.2);
  const Table table = MakeTable(content);
  Random random(25);
  for (int trial = 0; trial < 20; ++trial) {
    const JointArray q = RandomTarget(content, &random);
    ExpectCorrected(table, q);
    const Correction by_table = CorrectByTable(table, q.data());
    Eigen::VectorXd change(7);
    for (int i = 0; i < 7; ++i) change(i) = by_table.q[i] - q[i];
    EXPECT_GT(change.norm(), 1e-4);
    EXPECT_NEAR(change.dot(NullDirection(content.arm, by_table.q)), 0, 1e-8);
  }
}

// Fewer than six: what can't be met is left, by the weights of exact compensation.
TEST(CorrectByTable, LeavesTheLeastWithFewerJoints) {
  for (const std::vector<bool>& prismatic :
       {std::vector<bool>(5, false), std::vector<bool>{false, false, true, false}}) {
    const Arm arm = testing::RandomArm(prismatic, 1e-3, 2);
    const TableContent content = testing::PlainContent(arm, 0.2);
    const Table table = MakeTable(content);
    Random random(26);
    for (int trial = 0; trial < 20; ++trial) {
      const JointArray q = RandomTarget(content, &random);
      const Correction by_table = CorrectByTable(table, q.data());
      const Correction exact = CorrectJoints(arm, q.data(), ExactOptions());
      ASSERT_EQ(by_table.outcome, Outcome::kOk);
      const Twist left = LeftByTable(table, q, by_table);
      EXPECT_NEAR(by_table.position_error_m, left.head<3>().norm(), kRounding);
      EXPECT_NEAR(by_table.rotation_error_rad, left.tail<3>().norm(), kRounding);
      for (size_t i = 0; i < prismatic.size(); ++i)
        EXPECT_NEAR(by_table.q[i], exact.q[i], 1e-3) << "three nodes leave 1e-4 of the flange";
    }
  }
}

// Where rotation may be as it likes. Would catch joints called at rest by the tolerance of rotation
// alone: the point that a SCARA puts into place would be off by more than the table allows.
TEST(CorrectByTable, FewerJointsComeToRestForThePositionToo) {
  for (const std::vector<bool>& prismatic :
       {std::vector<bool>(5, false), std::vector<bool>{false, false, true, false}}) {
    TableContent content = testing::PlainContent(testing::RandomArm(prismatic, 1e-3, 2), 0.2);
    const Table finest = MakeTable(content);
    content.header.tolerance = {1e-6, 1};
    const Table table = MakeTable(content);
    Random random(29);
    for (int trial = 0; trial < 20; ++trial) {
      const JointArray q = RandomTarget(content, &random);
      const Pose reached = testing::FlangeByTable(table, CorrectByTable(table, q.data()).q.data());
      const Pose expected =
          testing::FlangeByTable(finest, CorrectByTable(finest, q.data()).q.data());
      EXPECT_LT((reached.p - expected.p).norm(), 2e-9) << "a thousandth of 1 um, and rounding";
    }
  }
}

// Joints over the error that they undo, both in radians.
double GainOf(const TableContent& content, const JointArray& target, const Correction& corrected) {
  const Twist error = Between(NominalFlange(content.arm, target.data()),
                              testing::FlangeByTable(MakeTable(content), target.data()));
  double moved = 0;
  for (int i = 0; i < content.header.joints; ++i)
    moved = std::max(moved, std::abs(corrected.q[i] - target[i]));
  return moved /
         (error.head<3>().norm() / content.header.characteristic_length_m + error.tail<3>().norm());
}

// Would catch joints called ok where the search for them did not settle, or went far for the error:
// exact correction refuses both. The two differ by how the correction changes along the way, which
// decides near the border: at most one in ten of what exact correction refuses may pass here.
TEST(CorrectByTable, RefusesWithFewerJointsWhatExactCorrectionRefuses) {
  int refused = 0, passed = 0, corrected = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const std::vector<bool> revolute(3 + seed % 3, false);
    TableContent content = testing::PlainContent(testing::RandomArm(revolute, 1e-2, seed), 0.2);
    content.header.smallest_singular_value = 1e-3;
    const Table table = MakeTable(content);
    Random random(seed);
    for (int trial = 0; trial < 30; ++trial) {
      const JointArray q = RandomTarget(content, &random);
      const Correction by_table = CorrectByTable(table, q.data());
      const bool ok = by_table.outcome == Outcome::kOk;
      corrected += ok ? 1 : 0;
      EXPECT_TRUE(!ok || GainOf(content, q, by_table) <= 100 * (1 + 1e-6)) << seed;
      EXPECT_TRUE(by_table.outcome != Outcome::kNearSingular || by_table.q == q) << seed;
      if (CorrectJoints(content.arm, q.data(), {}).outcome == Outcome::kOk) continue;
      ++refused;
      passed += ok ? 1 : 0;
    }
  }
  EXPECT_GT(refused, 50);
  EXPECT_LE(passed, refused / 10);
  EXPECT_GT(corrected, 1000);
}

// Coupled joints, other signs, an offset: the same pose, in the controller's numbers.
TEST(CorrectByTable, SpeaksTheControllersJoints) {
  TableContent content = FineContent();
  content.arm.joint_scale(1, 1) = -1;
  content.arm.joint_scale(2, 1) = 1;
  content.arm.joint_offset(2) = 0.3;
  content.arm.joint_offset(4) = -0.1;
  for (JointLimits& limits : content.arm.limits) limits = {};
  const Table plain = MakeTable(FineContent()), mapped = MakeTable(content);
  Random random(27);
  for (int trial = 0; trial < 50; ++trial) {
    const JointArray q_chain = RandomTarget(FineContent(), &random);
    JointArray q{}, back{};
    ToController(content.arm, q_chain.data(), q.data());
    const Correction expected = CorrectByTable(plain, q_chain.data());
    const Correction found = CorrectByTable(mapped, q.data());
    ASSERT_EQ(found.outcome, expected.outcome);
    ToChain(content.arm, found.q.data(), back.data());
    for (int i = 0; i < 6; ++i) EXPECT_NEAR(back[i], expected.q[i], 1e-9) << "the tolerance";
  }
}

// A table with a wrist singularity in its domain.
TableContent WithWristSingularity() {
  TableContent content = testing::Ur10Content(testing::Ur10Arm(3e-4), {4, 4, 3, 5});
  content.axis[4].lower = -1;
  content.axis[4].upper = 1;
  testing::FillNodes(&content);
  return content;
}

// A table that is to correct everywhere, asked where the wrist is straight to the last bit. Would
// catch a step taken from a matrix that has no inverse and called the last: what it left undone
// would be reported as nothing.
TEST(CorrectByTable, NeverBelievesAStepThatSolvesNothing) {
  TableContent content = WithWristSingularity();
  content.header.smallest_singular_value = 0;
  const Table table = MakeTable(content);
  Random random(30);
  for (int trial = 0; trial < 100; ++trial) {
    JointArray q = RandomTarget(content, &random);
    q[4] = 0;
    if (CorrectByTable(table, q.data()).outcome == Outcome::kOk) ExpectCorrected(table, q);
  }
}

// On both sides of the stated smallest singular value, never a correction below it; and never a
// refusal above it, which a bound that is not exact would give.
TEST(CorrectByTable, RefusesNearSingularitiesExactly) {
  const TableContent content = WithWristSingularity();
  const Table table = MakeTable(content);
  Random random(28);
  int refused = 0, corrected = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    JointArray q = RandomTarget(content, &random);
    q[4] = random.Uniform(-0.2, 0.2);
    const double value = SmallestSingularValue(table.arm, q.data(), 0.6);
    const Correction correction = CorrectByTable(table, q.data());
    if (value < content.header.smallest_singular_value) {
      ++refused;
      EXPECT_EQ(correction.outcome, Outcome::kNearSingular);
      EXPECT_NEAR(correction.smallest_singular_value, value, 1e-12);
      EXPECT_EQ(correction.q, q);
    } else {
      corrected += correction.outcome == Outcome::kOk ? 1 : 0;
      EXPECT_NE(correction.outcome, Outcome::kNearSingular) << value;
    }
  }
  EXPECT_GT(refused, 200);
  EXPECT_GT(corrected, 200);
}

// At a singularity itself, where the Jacobian has no inverse.
TEST(CorrectByTable, RefusesASingularity) {
  const TableContent content = WithWristSingularity();
  const Table table = MakeTable(content);
  JointArray q = testing::JointsAt(content, {0.1, -1.5, 1.5, -1.6, 0, 0.3});
  EXPECT_EQ(CorrectByTable(table, q.data()).outcome, Outcome::kNearSingular);
}

TEST(CorrectByTable, RefusesOutsideOfTheDomainWithTheAxis) {
  const Table table = MakeTable(FineContent());
  Random random(29);
  for (int axis = 0; axis < 6; ++axis) {
    std::vector<double> u = {0, -1.5, 1.5, -1.6, -1.5, 0};
    u[axis] = FineContent().axis[axis].upper + 1e-9;
    const JointArray q = testing::JointsAt(FineContent(), u);
    const Correction refused = CorrectByTable(table, q.data());
    EXPECT_EQ(refused.outcome, Outcome::kOutsideDomain);
    EXPECT_EQ(refused.joint, axis);
    EXPECT_EQ(refused.q, q);
  }
}

// Without a margin the corrected joints of a target on the rim may lie where no node is: refused,
// not extrapolated.
TEST(CorrectByTable, NeverLeavesTheNodesForCorrectedJoints) {
  TableContent content = testing::Ur10Content(testing::Ur10Arm(1e-3), {3, 3, 3, 3});
  for (int i = 1; i < 5; ++i) content.axis[i].margin = 0;
  testing::FillNodes(&content);
  const Table table = MakeTable(content);
  int refused = 0;
  for (int corner = 0; corner < 16; ++corner) {
    std::vector<double> u(6, 0.0);
    for (int i = 0; i < 4; ++i)
      u[i + 1] =
          corner >> i & 1 ? content.axis[i + 1].upper - 1e-9 : content.axis[i + 1].lower + 1e-9;
    const Correction correction = CorrectByTable(table, testing::JointsAt(content, u).data());
    const bool outside = correction.outcome == Outcome::kOutsideDomain;
    refused += outside ? 1 : 0;
    if (correction.outcome == Outcome::kOk) {
      EXPECT_EQ(LookUp(table, correction.q.data(), Reach::kGrid).fault, LookupFault::kNone);
    }
  }
  EXPECT_GT(refused, 8)
      << "half of the corners at least, each axis pushes outwards at half of them";
}

TEST(CorrectByTable, RefusesBeyondALimitAndNamesTheJoint) {
  Random random(30);
  for (int joint = 0; joint < 6; ++joint) {
    const JointArray q = RandomTarget(FineContent(), &random);
    const Correction free = CorrectByTable(MakeTable(FineContent()), q.data());
    TableContent content = FineContent();
    content.arm.limits[joint].upper = (q[joint] + free.q[joint]) / 2;
    content.arm.limits[joint].lower = -INFINITY;
    if (free.q[joint] < q[joint])
      content.arm.limits[joint] = {content.arm.limits[joint].upper, INFINITY};
    const Correction refused = CorrectByTable(MakeTable(content), q.data());
    EXPECT_EQ(refused.outcome, Outcome::kBeyondLimit);
    EXPECT_EQ(refused.joint, joint);
  }
}

TEST(CorrectByTable, RefusesWhatIsNoNumberAndMeasuringArms) {
  JointArray q = testing::JointsAt(FineContent(), {0, -1.5, 1.5, -1.6, -1.5, 0});
  TableContent measuring = FineContent();
  measuring.arm.measuring = true;
  EXPECT_EQ(CorrectByTable(MakeTable(measuring), q.data()).outcome, Outcome::kInvalidArgument);
  const Table table = MakeTable(FineContent());
  for (int joint = 0; joint < 6; ++joint) {
    JointArray bad = q;
    bad[joint] = NAN;
    EXPECT_EQ(CorrectByTable(table, bad.data()).outcome, Outcome::kInvalidArgument);
    bad[joint] = -INFINITY;
    EXPECT_EQ(CorrectByTable(table, bad.data()).outcome, Outcome::kInvalidArgument);
  }
}

// A measuring arm's tip is where the identified chain has it, as near as the nodes are dense; near
// singularities too.
TEST(TipByTable, IsWhereTheIdentifiedChainHasIt) {
  TableContent content = FineContent();
  content.arm.measuring = true;
  const Table table = MakeTable(content);
  const Pose X_FT{ExpRotation<double>(Eigen::Vector3d(0.1, 0.2, -0.3)), {0.01, 0.02, 0.1}};
  const Eigen::Vector3d axis_T = Eigen::Vector3d::UnitX();
  Random random(31);
  for (int trial = 0; trial < 100; ++trial) {
    const JointArray q = RandomTarget(content, &random);
    const Tip by_table = TipByTable(table, q.data(), X_FT, axis_T);
    const Tip exact = CorrectedTip(content.arm, q.data(), X_FT, axis_T);
    ASSERT_EQ(by_table.outcome, Outcome::kOk);
    EXPECT_LT((by_table.X_BT.p - exact.X_BT.p).norm(), 2e-5);
    EXPECT_LT((by_table.axis_B - exact.axis_B).norm(), 2e-5);
  }
}

TEST(TipByTable, RefusesWithTheReason) {
  const Table table = MakeTable(FineContent());
  JointArray q = testing::JointsAt(FineContent(), {0, -1.5, 1.5, -1.6, -1.5, 0});
  const Eigen::Vector3d axis = Eigen::Vector3d::UnitX();
  Pose mirror;
  mirror.R(0, 0) = -1;
  EXPECT_EQ(TipByTable(table, q.data(), mirror, axis).outcome, Outcome::kInvalidArgument);
  q[1] = 0;
  EXPECT_EQ(TipByTable(table, q.data(), Pose(), axis).outcome, Outcome::kOutsideDomain);
  q[1] = NAN;
  EXPECT_EQ(TipByTable(table, q.data(), Pose(), axis).outcome, Outcome::kInvalidArgument);
}

}  // namespace
}  // namespace truepose::compensation
