// Joints at poses of a box, and the domain that comes of them.
#include "core/compensation/pose_finder.h"

#include <gtest/gtest.h>

#include "compensation/kinematics.h"
#include "core/base/random.h"
#include "core/compensation/pose_samples.h"
#include "core/compensation/table_domain.h"
#include "tests/core/compensation/drawn_arm.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using compensation::Arm;

// Tool down, elbow up, in front of the robot.
BoxDomain Ur10Box() {
  BoxDomain box;
  box.box_B = {Eigen::Vector3d(.4, -.4, .1), Eigen::Vector3d(.8, .4, .6)};
  box.cone_rad = 0.5;
  box.reference = (Eigen::VectorXd(6) << 3.3, -1.2, 1.8, -2.2, -1.57, 0).finished();
  return box;
}

// Would catch places that are reached elsewhere than they are, and a change of configuration: of a
// UR10 the elbow, the wrist and the shoulder each keep the sign of an angle.
TEST(PoseFinder, ReachesPlacesInOneConfiguration) {
  const Arm arm = testing::DrawnArm(testing::Ur10(), 1);
  const BoxDomain box = Ur10Box();
  const Places places(arm, box);
  PoseFinder finder(arm, box);
  Random random(1);
  int reached = 0;
  for (int i = 0; i < 500; ++i) {
    Place place;
    place << random.Uniform(.4, .8), random.Uniform(-.4, .4), random.Uniform(.1, .6),
        random.Uniform(-.3, .3), random.Uniform(-.3, .3), random.Uniform(-3, 3);
    const auto q = finder.Reach(place);
    if (!q) continue;
    ++reached;
    const Pose X_BF = compensation::NominalFlange(arm, q->data());
    EXPECT_LT(compensation::Remainder(places.FlangeAt(place), X_BF).norm(), 2e-6);
    EXPECT_LT((X_BF.p - place.head<3>()).norm(), 2e-6);
    EXPECT_GT(X_BF.R.col(2).dot(-Eigen::Vector3d::UnitZ()), std::cos(0.45));
    EXPECT_GT((*q)(2), 0);
    EXPECT_LT((*q)(4), 0);
  }
  EXPECT_EQ(reached, 500);
}

// Would catch a pose that is called reached beyond the reach, beyond a limit or behind a
// singularity.
TEST(PoseFinder, CountsWhatIsNotReached) {
  const Robot robot = testing::Ur10();
  BoxDomain box = Ur10Box();
  box.box_B = {Eigen::Vector3d(1.5, -.1, .1), Eigen::Vector3d(1.8, .1, .6)};
  EXPECT_EQ(SamplePoses(testing::DrawnArm(robot, 1), box, 100, 0.5, 1).unreachable, 100);
  box = Ur10Box();
  box.reference(0) -= 6.28;  // the same pose, but the limits below end in between
  Arm arm = testing::DrawnArm(robot, 1);
  EXPECT_EQ(SamplePoses(arm, box, 100, 0.5, 1).unreachable, 0);
  arm.limits[2].upper = 1.8;
  const PoseSamples samples = SamplePoses(arm, box, 400, 0.5, 1);
  EXPECT_GT(samples.unreachable, 40);
  EXPECT_EQ(samples.q_chain.size() + samples.unreachable, 400u);
  for (const JointVector& q : samples.q_chain) EXPECT_LE(q(2), 1.8);
}

// Would catch a domain that leaves out places of its box: 3 % of widening is there for that.
TEST(DomainOf, HoldsThePlacesOfItsBox) {
  const Arm arm = testing::DrawnArm(testing::Ur10(), 1);
  TableSpec spec;
  spec.box = Ur10Box();
  const auto domain = DomainOf(arm, spec);
  ASSERT_TRUE(domain.ok()) << domain.status();
  const PoseSamples fresh = SamplePoses(arm, *spec.box, 5000, 0, 77);
  int outside = 0;
  for (const JointVector& q : fresh.q_chain) {
    const JointVector u = domain->axes.FromChain(q);
    for (int k = 0; k < 6; ++k)
      outside += u(k) < domain->range[k].lower || u(k) > domain->range[k].upper;
  }
  EXPECT_EQ(outside, 0);
  EXPECT_EQ(fresh.unreachable, 0);
  // q2 + q3 + q4 is as narrow as the cone, roughly; q4 alone is twice that.
  EXPECT_EQ(domain->axes.weight()(3, 1), 1);
  EXPECT_LT(domain->range[3].width(), 1.3);
}

// Of a box that ends beyond the arm's reach. Would catch a share that counts the rim of the box and
// of the cone, where half the poses are drawn that find the domain's ranges.
TEST(DomainOf, TellsTheShareOfItsVolumeThatIsNotReached) {
  const Arm arm = testing::DrawnArm(testing::Ur10(), 1);
  TableSpec spec;
  spec.box = Ur10Box();
  spec.box->box_B.max().x() += 0.7;
  const auto domain = DomainOf(arm, spec);
  ASSERT_TRUE(domain.ok()) << domain.status();
  const double share = SamplePoses(arm, *spec.box, 10000, 0, 78).unreachable / 1e4;
  EXPECT_GT(share, 0.02);
  EXPECT_LT(share, 0.6);
  // Five standard deviations of a share of 2,000 at most.
  EXPECT_NEAR(static_cast<double>(domain->unreachable) / domain->poses, share, 0.05);
}

// An arm of five joints meets the position; would catch that its orientation is asked for.
TEST(PoseFinder, PutsPositionFirstWithFewJoints) {
  const Arm arm = testing::DrawnArm(testing::MeasuringArm(), 1);
  BoxDomain box;
  box.reference = (Eigen::VectorXd(5) << 0, .9, -1.6, .3, 1.1).finished();
  const Eigen::Vector3d p = compensation::NominalFlange(arm, box.reference.data()).p;
  box.box_B = {p - Eigen::Vector3d::Constant(0.05), p + Eigen::Vector3d::Constant(0.05)};
  box.cone_rad = 0.2;
  const PoseSamples samples = SamplePoses(arm, box, 200, 0, 1);
  EXPECT_LT(samples.unreachable, 20);
  for (const JointVector& q : samples.q_chain)
    EXPECT_TRUE(box.box_B.exteriorDistance(compensation::NominalFlange(arm, q.data()).p) < 2e-3);
}

}  // namespace
}  // namespace truepose
