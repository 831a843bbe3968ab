// The closed form of arms with a spherical wrist against damped Newton from 500 places.
#include "compensation/spherical_wrist.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "compensation/inverse.h"
#include "compensation/singularity.h"
#include "tests/compensation/arms.h"
#include "tests/compensation/wrist_arms.h"

namespace truepose::compensation {
namespace {

using truepose::testing::AllTypesOfThree;
using truepose::testing::DhWristArm;
using truepose::testing::kDeg;
using truepose::testing::NominalArm;
using truepose::testing::PumaRows;
using truepose::testing::RandomVector;
using truepose::testing::RandomWristArm;

constexpr double kPi = std::numbers::pi;
constexpr double r = 90 * kDeg;

// The first three joints. Rows of D&H: theta, d, a, alpha.
struct Shoulder {
  const char* name;
  const char* types;
  std::vector<DhRow> rows;
};

std::vector<Shoulder> RevoluteShoulders() {
  return {
      {"Puma: axes 1 and 2 meet", "RRR", PumaRows()},
      {"KUKA: axis 2 beside axis 1", "RRR", {{0, .4, .18, -r}, {0, 0, .6, 0}, {-r, 0, .12, -r}}},
      {"axes 1 and 2 parallel", "RRR", {{0, .3, .4, 0}, {0, .1, .1, r}, {0, 0, .35, -r}}},
      {"nothing at right angles",
       "RRR",
       {{.2, .4, .15, 70 * kDeg}, {.1, .1, .5, 25 * kDeg}, {0, .1, .1, -50 * kDeg}}},
      {"elbow without offsets", "RRR", {{0, .4, 0, r}, {0, 0, .5, 0}, {r, 0, 0, r}}},
  };
}

// With prismatic joints where an equation loses its degree.
std::vector<Shoulder> SlidingShoulders() {
  return {
      {"Stanford: axes 1 and 2 meet", "RRP", {{0, .412, 0, r}, {0, .154, 0, r}, {0, .4, 0, 0}}},
      {"spherical: axes 1, 2 and W's meet", "RRP", {{0, .4, 0, r}, {0, 0, 0, r}, {0, 0, 0, 0}}},
      {"axes 1 and 2 parallel", "RRP", {{0, .3, .4, 0}, {0, .1, .1, 1}, {0, 0, .2, .3}}},
      {"SCARA: three parallel", "RRP", {{0, .3, .4, 0}, {0, .1, .3, 0}, {0, 0, 0, r}}},
      {"joint 3 slides along axis 2", "RRP", {{0, .3, .1, r}, {0, .1, .3, 0}, {0, 0, .2, r}}},
      {"cylinder: up, then out", "RPP", {{0, .3, 0, 0}, {0, .1, .1, r}, {0, 0, 0, r}}},
      {"cylinder: out, then up", "RPP", {{0, .3, .1, r}, {0, .1, 0, r}, {0, 0, 0, .4}}},
      {"slide along axis 1", "RPR", {{0, .3, .2, 0}, {0, .1, .3, 0}, {0, 0, .25, r}}},
      {"slide at right angles to axis 1", "RPR", {{0, .3, .1, r}, {0, .1, .2, .4}, {0, 0, .3, r}}},
      {"axes 1 and 3 one line", "RPR", {{0, .3, 0, 0}, {0, .1, .3, .8}, {0, 0, .25, r}}},
      {"elbow on a column", "PRR", {{0, .3, 0, 0}, {0, .1, .4, 0}, {0, 0, .35, r}}},
      {"turn at right angles to the track", "PRR", {{0, .3, 0, r}, {0, .1, .4, 1}, {0, 0, .3, r}}},
      {"turn along the track", "PRR", {{0, .3, .1, 0}, {0, .1, .2, r}, {0, 0, .3, r}}},
      {"cylinder on a column", "PRP", {{0, .3, 0, 0}, {0, .1, 0, r}, {0, 0, 0, r}}},
      {"turret on a track", "PRP", {{0, .3, 0, r}, {0, .1, .1, .6}, {0, 0, 0, .3}}},
      {"slide along the turret", "PRP", {{0, .3, 0, r}, {0, .1, .1, 0}, {0, 0, .2, .3}}},
      {"portal with a turned arm", "PPR", {{0, .3, 0, r}, {0, .1, .1, r}, {0, 0, .3, r}}},
      {"gantry", "PPP", {{0, .3, 0, r}, {r, .2, 0, r}, {0, .1, 0, .2}}},
      {"oblique slides", "PPP", {{0, .3, .1, .7}, {.4, .2, 0, 1.1}, {0, .1, 0, .2}}},
  };
}

// Turns modulo whole ones, lengths in m.
double Apart(const Arm& arm, const JointArray& a, const JointArray& b) {
  double largest = 0;
  for (int i = 0; i < 6; ++i) {
    const double away = a[i] - b[i];
    largest = std::max(largest,
                       std::abs(arm.nominal.prismatic[i] ? away : std::remainder(away, 2 * kPi)));
  }
  return largest;
}

template <typename Places>
double DistanceTo(const Arm& arm, const Places& places, int count, const JointArray& q) {
  double nearest = 1e9;
  for (int i = 0; i < count; ++i) nearest = std::min(nearest, Apart(arm, places[i], q));
  return nearest;
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
    if (DistanceTo(arm, found, static_cast<int>(found.size()), solved.v) >= 1e-5)
      found.push_back(solved.v);
  }
  return found;
}

void ExpectAllFound(const Arm& arm, const Pose& X, const JointArray& reference,
                    const std::string& what) {
  const Branches branches = AllBranches(arm, X, reference.data(), {});
  ASSERT_TRUE(branches.closed_form) << what;
  EXPECT_LE(branches.count, 8) << what;
  for (int i = 0; i < branches.count; ++i) {
    const Twist e = Remainder(X, NominalFlange(arm, branches.q[i].data()));
    EXPECT_LT(e.norm(), 1e-9) << what;
    EXPECT_GT(DistanceTo(arm, branches.q, i, branches.q[i]), 1e-6) << what;
  }
  for (const JointArray& q : BruteForce(arm, X))
    EXPECT_LT(DistanceTo(arm, branches.q, branches.count, q), 1e-5)
        << what << ", " << branches.count << " branches";
}

// Before any polishing, so that Newton can't cover for it: every branch has a candidate within
// `tolerance`.
void ExpectGoodCandidates(const Arm& arm, const Pose& X, const JointArray& reference,
                          double tolerance, const std::string& what) {
  const Branches branches = AllBranches(arm, X, reference.data(), {});
  const SphericalWrist wrist = SphericalWristOf(arm.nominal);
  const WristBranches candidates = WristCandidates(arm.nominal, wrist, X, reference.data());
  for (int i = 0; i < branches.count; ++i)
    EXPECT_LT(DistanceTo(arm, candidates.q, candidates.count, branches.q[i]), tolerance) << what;
  // What is none is left from two roots that have just merged, so stands nearly there.
  for (int i = 0; i < candidates.count; ++i) {
    const Twist e = Remainder(X, NominalFlange(arm, candidates.q[i].data()));
    EXPECT_LT(e.norm(), 100 * tolerance) << what;
  }
}

JointArray RandomJoints(Random* random) {
  JointArray q{};
  for (int i = 0; i < 6; ++i) q[i] = random->Uniform(-1, 1) * (i < 3 ? 1.2 : kPi);
  return q;
}

// That are not singular, `count` of at most ten times as many.
std::vector<JointArray> PlacesOf(const Arm& arm, size_t count) {
  Random random(81);
  const double length = CharacteristicLength(arm.nominal);
  std::vector<JointArray> places;
  for (size_t draw = 0; draw < 10 * count && places.size() < count; ++draw) {
    const JointArray q = RandomJoints(&random);
    if (SmallestSingularValue(arm, q.data(), length) > 1e-2) places.push_back(q);
  }
  return places;
}

// Near double roots a candidate is right to 1e-4.
void ExpectAllFoundAt(const std::vector<JointArray>& places, const Arm& arm,
                      const std::string& what, double tolerance = 1e-4) {
  for (const JointArray& q : places) {
    ExpectAllFound(arm, NominalFlange(arm, q.data()), q, what);
    ExpectGoodCandidates(arm, NominalFlange(arm, q.data()), q, tolerance, what);
  }
}

// Of an arm that is regular nearly everywhere.
void ExpectAllFoundAt(size_t count, const Arm& arm, const std::string& what,
                      double tolerance = 1e-4) {
  const std::vector<JointArray> places = PlacesOf(arm, count);
  EXPECT_EQ(places.size(), count) << what;
  ExpectAllFoundAt(places, arm, what, tolerance);
}

// A root lost to a degenerate shoulder, a wrist solution left out, an angle on the wrong side.
TEST(SphericalWrist, FindsAllThatBruteForceFinds) {
  for (const Shoulder& shoulder : RevoluteShoulders()) {
    for (const double wrist : {90.0, 60.0})
      ExpectAllFoundAt(10, DhWristArm(shoulder.rows, shoulder.types, wrist * kDeg), shoulder.name);
  }
}

// Each type pattern with skew constants: a wrong coefficient of an equation, which the right angles
// of built arms hide.
TEST(SphericalWrist, AnyGeometryOfAnyTypes) {
  for (const std::string& types : AllTypesOfThree()) {
    Random random(82);
    int geometries = 0;
    for (int draw = 0; draw < 40 && geometries < 6; ++draw) {
      const Arm arm = RandomWristArm(types, &random);
      const std::vector<JointArray> places = PlacesOf(arm, 4);
      if (places.size() < 4) continue;  // bad by chance, such as slides nearly in one plane
      ++geometries;
      ExpectAllFoundAt(places, arm, types);
    }
    EXPECT_EQ(geometries, 6) << types;
  }
}

// Parallel, meeting and perpendicular axes: an equation that loses its degree, two q2 to one q3.
TEST(SphericalWrist, SlidingShouldersAsBuilt) {
  for (const Shoulder& shoulder : SlidingShoulders())
    ExpectAllFoundAt(6, DhWristArm(shoulder.rows, shoulder.types, 70 * kDeg),
                     std::string(shoulder.types) + ", " + shoulder.name);
  ExpectAllFoundAt(12, NominalArm(truepose::testing::Stanford()), "Stanford");
}

// The same with axes tilted to either side of what counts as parallel: an equation divided by what
// is nearly nothing, or one with a small part neglected.
TEST(SphericalWrist, NearlyDegenerateShoulders) {
  for (const Shoulder& shoulder : SlidingShoulders()) {
    for (const double tilt : {1e-3, 3e-5, 2e-6, 3e-7}) {
      std::vector<DhRow> rows = shoulder.rows;
      rows[0].alpha += tilt;
      rows[1].alpha -= 0.7 * tilt;
      rows[1].a += 0.6 * tilt;
      ExpectAllFoundAt(2, DhWristArm(rows, shoulder.types, 70 * kDeg),
                       std::string(shoulder.types) + ", " + shoulder.name, 5e-3);
    }
  }
}

TEST(SphericalWrist, EightBranchesOfAPuma) {
  const Arm arm = DhWristArm(PumaRows(), "RRR", r);
  const JointArray q = {0.4, -0.7, 0.5, 0.6, 0.8, -0.3};
  const Branches branches = AllBranches(arm, NominalFlange(arm, q.data()), q.data(), {});
  EXPECT_EQ(branches.count, 8);
  EXPECT_LT(Apart(arm, branches.q[0], q), 1e-9);  // nearest first
}

// Two shoulders, the slide out to either side, the wrist flipped or not.
TEST(SphericalWrist, BranchesOfAStanfordArm) {
  Arm arm = NominalArm(truepose::testing::Stanford());
  const JointArray q = {0.4, -0.7, 0.3, 0.6, 0.8, -0.3};
  const Pose X = NominalFlange(arm, q.data());
  const Branches branches = AllBranches(arm, X, q.data(), {});
  EXPECT_TRUE(branches.closed_form);
  EXPECT_EQ(branches.count, 8);
  EXPECT_LT(Apart(arm, branches.q[0], q), 1e-9);
  arm.limits[2] = {-0.3, 1};  // the rail of D&H row 3 adds 0.4 m: only outward
  const Branches outward = AllBranches(arm, X, q.data(), {});
  EXPECT_EQ(outward.count, 4);
  for (int i = 0; i < outward.count; ++i) EXPECT_GT(outward.q[i][2], -0.3);
  arm.limits[2] = {0.31, 1};
  const Branches none = AllBranches(arm, X, q.data(), {});
  EXPECT_EQ(none.count, 0);
  EXPECT_EQ(none.outcome, Outcome::kBeyondLimit);
  EXPECT_EQ(none.joint, 2);
}

// Singular places: a straight wrist and a wrist centre over axis 1 leave joints free, which stay
// where the reference is.
TEST(SphericalWrist, FreeJointsStayAtTheReference) {
  const Arm elbow = DhWristArm(RevoluteShoulders()[4].rows, "RRR", r);
  const Arm spherical = DhWristArm(SlidingShoulders()[1].rows, "RRP", r);
  const JointArray straight = {0.4, -0.7, 0.5, 0.6, 0, -0.3};
  // Elbow without offsets: q2 = pi / 2 and q3 = 0 put everything over axis 1, the spherical arm's
  // q2 = 0 does.
  const JointArray elbow_above = {0.4, kPi / 2, 0, 0.6, 0.9, -0.3};
  const JointArray spherical_above = {0.4, 0, 0.5, 0.6, 0.9, -0.3};
  // W in the centre of the shoulder: joint 2 is free as well.
  const JointArray centred = {0.4, 0.9, -0.43, 0.6, 0.9, -0.3};
  const std::pair<const Arm*, JointArray> places[] = {{&elbow, straight},
                                                      {&elbow, elbow_above},
                                                      {&spherical, straight},
                                                      {&spherical, spherical_above},
                                                      {&spherical, centred}};
  for (const auto& [arm, q] : places) {
    const Branches branches = AllBranches(*arm, NominalFlange(*arm, q.data()), q.data(), {});
    ASSERT_GE(branches.count, 1);
    EXPECT_LT(Apart(*arm, branches.q[0], q), 1e-6);
  }
}

// Stretched, folded, over an axis, straight and all at once, as arms stand at home. Would catch a
// free joint that noise moves away from the reference, and a pose given up because two double roots
// are right to 1e-8 only where 1e-10 is asked for.
TEST(SphericalWrist, EverySingularPlaceIsReachedAtTheReference) {
  std::vector<Shoulder> shoulders = RevoluteShoulders();
  for (Shoulder& shoulder : SlidingShoulders()) shoulders.push_back(shoulder);
  const double turns[] = {0, kPi / 2, 0.5, kPi}, slides[] = {0, 0.2, -0.43, 0.3};
  for (const Shoulder& shoulder : shoulders) {
    const Arm arm = DhWristArm(shoulder.rows, shoulder.types, r);
    for (int draw = 0; draw < 4 * 4 * 3; ++draw) {
      const auto& third = arm.nominal.prismatic[2] ? slides : turns;
      const JointArray q = {0.5, turns[draw % 4],   third[draw / 4 % 4],
                            0.3, 0.7 * (draw / 16), -0.4};
      const Branches branches = AllBranches(arm, NominalFlange(arm, q.data()), q.data(), {});
      ASSERT_EQ(branches.outcome, Outcome::kOk) << shoulder.name;
      EXPECT_LT(Apart(arm, branches.q[0], q), 1e-5) << shoulder.types << ", " << shoulder.name;
    }
  }
}

// A wrist that is straight but for the last digits of the pose: q4 is told by them, whatever the
// reference. Would catch a straight wrist taken for one, and a q5 that is not right to them.
TEST(SphericalWrist, NearlyStraightWrists) {
  const Arm arm = NominalArm(truepose::testing::Stanford());
  for (const double bent : {1e-5, 1e-7, 1e-9, 1e-11}) {
    const JointArray q = {0.4, -0.7, 0.3, 0.6, bent, -0.3}, reference = {0, 0, 0, -1, 0.5, 0};
    const Pose X = NominalFlange(arm, q.data());
    const Branches branches = AllBranches(arm, X, reference.data(), {});
    ASSERT_EQ(branches.outcome, Outcome::kOk) << bent;
    EXPECT_LT(Remainder(X, NominalFlange(arm, branches.q[0].data())).norm(), 2e-10) << bent;
  }
}

// First three joints that move W on a surface only, whatever they do.
std::vector<Shoulder> ShouldersThatCannotPlace() {
  return {
      {"three parallel", "RRR", {{0, .3, .4, 0}, {0, .1, .3, 0}, {0, 0, .35, 0}}},
      {"axes 1, 2 and 3 meet", "RRR", {{0, .4, 0, r}, {0, 0, 0, -r}, {0, 0, .4, r}}},
      {"axes 1 and 2 one line", "RRR", {{0, .3, 0, 0}, {0, .1, .3, r}, {0, 0, .35, r}}},
      {"axes 2 and 3 one line", "RRR", {{0, .3, .4, r}, {0, .1, 0, 0}, {0, 0, .35, r}}},
      {"joint 3 through W", "RRR", {{0, .3, .4, r}, {0, .1, .3, .7}, {0, 0, 0, 0}}},
      {"W on axes 1 and 2", "RRP", {{0, .3, .4, r}, {0, .1, 0, 0}, {0, 0, 0, 0}}},
      {"slide between parallel turns", "RPR", {{0, .3, .4, r}, {0, .1, 0, -r}, {0, 0, .4, 0}}},
      {"slides in one plane", "PPP", {{0, .3, 0, r}, {0, .1, 0, r}, {0, .1, 0, .4}}},
      {"turn along two slides' normal", "PPR", {{0, .3, 0, r}, {r, .1, 0, r}, {0, .1, 0, .4}}},
  };
}

TEST(SphericalWrist, WhatIsNoneIsNotTakenForOne) {
  EXPECT_FALSE(SphericalWristOf(NominalArm(truepose::testing::Ur10()).nominal).is_one);
  EXPECT_FALSE(SphericalWristOf(NominalArm(truepose::testing::Panda()).nominal).is_one);
  for (const Shoulder& shoulder : ShouldersThatCannotPlace())
    EXPECT_FALSE(SphericalWristOf(DhWristArm(shoulder.rows, shoulder.types, r).nominal).is_one)
        << shoulder.types << ", " << shoulder.name;
  // Off by 0.1 mm: Newton.
  Arm nearly = DhWristArm(PumaRows(), "RRR", r);
  nearly.nominal.constant[5].p.x() += 1e-4;
  EXPECT_FALSE(SphericalWristOf(nearly.nominal).is_one);
  for (size_t joint = 3; joint < 6; ++joint) {
    Arm sliding = DhWristArm(PumaRows(), "RRR", r);
    sliding.nominal.prismatic[joint] = true;
    EXPECT_FALSE(SphericalWristOf(sliding.nominal).is_one) << joint;
  }
}

}  // namespace
}  // namespace truepose::compensation
