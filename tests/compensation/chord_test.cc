// The fast way of exact compensation: what it calls ok keeps what exact.h promises.
#include "compensation/chord.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "compensation/exact.h"
#include "compensation/singularity.h"
#include "tests/compensation/arms.h"

namespace truepose::compensation {
namespace {

using truepose::testing::Ur10Arm;

double SingularValueAt(const Arm& arm, const JointArray& q) {
  return SmallestSingularValue(arm, q.data(), CharacteristicLength(arm.nominal));
}

// Largest joint change over the error that it undoes, rad (lengths over the characteristic one).
double GainOf(const Arm& arm, const JointArray& from, const JointArray& to) {
  const Twist e = Remainder(NominalFlange(arm, from.data()), IdentifiedFlange(arm, from.data()));
  double moved = 0;
  for (int i = 0; i < arm.nominal.joints; ++i) moved = std::max(moved, std::abs(to[i] - from[i]));
  return moved / (e.head<3>().norm() / CharacteristicLength(arm.nominal) + e.tail<3>().norm());
}

JointArray NearlyStraightWrist(double bend, Random* random) {
  JointArray q{};
  for (int i = 0; i < 6; ++i) q[i] = random->Uniform(-2, 2);
  q[4] = bend * random->Uniform(-1, 1);
  return q;
}

// A robot of 9 m. Would catch lengths taken over a metre instead of the characteristic length, with
// which small errors of position may move the joints of a large robot further than is said.
TEST(Chord, GainOfALargeRobotCountsInItsLengths) {
  Arm arm = Ur10Arm(1e-6, 3).arm;
  for (JointChain* chain : {&arm.nominal, &arm.identified}) {
    for (Pose& constant : chain->constant) constant.p *= 8;
  }
  Random random(31);
  int ok = 0;
  for (int draw = 0; draw < 200; ++draw) {
    const JointArray q = NearlyStraightWrist(2e-3, &random);
    const Correction correction = CorrectJoints(arm, q.data(), {});
    if (correction.outcome != Outcome::kOk) continue;
    ++ok;
    const double sigma = std::min(SingularValueAt(arm, q), SingularValueAt(arm, correction.q));
    // One ten thousandth for the joints' rounding.
    EXPECT_TRUE(sigma >= 1e-3 || GainOf(arm, q, correction.q) <= 100 * (1 + 1e-4)) << draw;
  }
  EXPECT_GT(ok, 10);
}

// Numbers of an encoder gone wrong. Would catch joints that are called ok by sines which took a
// step that the joint itself has no digits for: what is reported is what is left.
TEST(Chord, ReportsWhatIsLeftOfHugeJointsToo) {
  Arm arm = Ur10Arm(1e-3, 3).arm;
  arm.limits = {};
  for (const double huge : {1e6, 1e9, 1e20, -1e300}) {
    for (int joint = 0; joint < 6; ++joint) {
      JointArray q = {0.3, -1.2, 1.5, -0.7, 0.9, 0.4};
      q[joint] = huge;
      const Correction correction = CorrectJoints(arm, q.data(), {});
      const Twist left =
          Remainder(NominalFlange(arm, q.data()), IdentifiedFlange(arm, correction.q.data()));
      EXPECT_NEAR(correction.position_error_m, left.head<3>().norm(), 1e-12) << huge;
      EXPECT_NEAR(correction.rotation_error_rad, left.tail<3>().norm(), 1e-12) << huge;
      EXPECT_TRUE(correction.outcome != Outcome::kOk || left.norm() < 1e-9) << huge;
    }
  }
}

// Would catch steps that are held against the remainder of the moment: beside a singularity that
// may grow, and the next step with it, until joints are far away for a small error.
TEST(Chord, AllStepsTogetherAreHeldAgainstTheFirstError) {
  Random random(32);
  int solved = 0;
  for (const double size : {1e-5, 1e-4}) {
    const Arm arm = Ur10Arm(size, 3).arm;
    for (int draw = 0; draw < 20000; ++draw) {
      const JointArray q = NearlyStraightWrist(1e3 * size, &random);
      ChordOptions options;
      options.characteristic_length_m = CharacteristicLength(arm.nominal);
      ChordState state;
      state.v = q;
      SetMotions(arm.identified, q.data(), &state.motions);
      if (!SolveByChords(arm, NominalFlange(arm, q.data()), options, &state)) continue;
      ++solved;
      EXPECT_LE(GainOf(arm, q, state.v), options.largest_gain) << draw;
    }
  }
  EXPECT_GT(solved, 1000);
}

}  // namespace
}  // namespace truepose::compensation
