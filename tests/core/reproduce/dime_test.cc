#include "core/reproduce/dime.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "core/reproduce/measuring_robot.h"
#include "core/reproduce/readings_of_dime.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

// Would catch a site too few and a second visit of the same wrist.
TEST(Dime, Has72HolesAnd81Poses) {
  const std::vector<DimePose> poses = Dime();
  ASSERT_EQ(poses.size(), 81u);
  for (size_t i = 0; i < 81; ++i) {
    EXPECT_EQ(poses[i].flipped, i >= 72);
    EXPECT_NEAR(poses[i].hole.axis_M.norm(), 1, 1e-15);
    EXPECT_LT(poses[i].hole.axis_M.z(), -0.7);  // every pin goes in from above
    for (size_t j = 0; j < i && i < 72; ++j) {
      EXPECT_GT((poses[i].hole.p_M - poses[j].hole.p_M).norm() +
                    (poses[i].hole.axis_M - poses[j].hole.axis_M).norm(),
                1e-3);
    }
  }
}

// The closed form puts the pin into every hole, away from the wrist's singularity. Would catch a
// wrong branch of the wrist or the elbow and a hole out of reach.
TEST(Dime, EveryHoleIsReachedByTheNominalRobot) {
  const Model model = MeasuringRobot();
  for (const DimePose& pose : Dime()) {
    const auto q = NominalJoints(pose);
    ASSERT_TRUE(q.ok()) << q.status();
    const Pose X = Forward(model, *q, Eigen::VectorXd::Zero(25));
    EXPECT_LT((X.p - pose.hole.p_M).norm(), 1e-14);
    EXPECT_LT((X.R.col(2) - pose.hole.axis_M).norm(), 1e-14);
    EXPECT_GE(std::abs(std::cos((*q)(4))), kLeastCosineOfWrist);
    EXPECT_EQ(std::cos((*q)(4)) < 0, pose.flipped);
  }
}

// Newton on the true robot, 1e-12 m and rad where its last step was. Would catch joints of the
// nominal robot given for those of the true one (4.7 mm).
TEST(Dime, EveryHoleIsReachedByATrueRobot) {
  const Model model = MeasuringRobot();
  Random random(4);
  const Eigen::VectorXd truth = *DrawTruth(model, {}, &random);
  for (const DimePose& pose : Dime()) {
    const auto q = JointsAt(model, truth, pose);
    ASSERT_TRUE(q.ok()) << q.status();
    const Pose X = Forward(model, *q, truth);
    EXPECT_LT((X.p - pose.hole.p_M).norm(), 1e-12);
    EXPECT_LT((X.R.col(2) - pose.hole.axis_M).norm(), 1e-12);
    EXPECT_LT((*q - *NominalJoints(pose)).norm(), 0.5);  // same configuration
  }
}

TEST(Dime, AHoleOutOfReachIsRefused) {
  const DimePose pose = {{Eigen::Vector3d(0.9, 0, 0.1), -Eigen::Vector3d::UnitZ()}, false};
  EXPECT_EQ(NominalJoints(pose).status().code(), absl::StatusCode::kFailedPrecondition);
}

// The mean at nominal parameters is the chapter's, to the 1e-9 m at which the scale is accepted.
TEST(ReadingsOfDime, TruthHasTheChaptersMeanError) {
  const Model model = MeasuringRobot();
  for (uint64_t seed : {1, 2, 3}) {
    Random random(seed);
    const Eigen::VectorXd truth = *DrawTruth(model, {}, &random);
    double sum = 0;
    for (const DimePose& pose : Dime()) {
      const Eigen::VectorXd q = *JointsAt(model, truth, pose);
      sum += (Forward(model, q, Eigen::VectorXd::Zero(25)).p - pose.hole.p_M).norm();
    }
    EXPECT_NEAR(sum / 81, 4.702e-3, 1e-9);
  }
}

// Would catch readings that are not multiples of the encoder's step, noise put on the hole that is
// reported, and a stated uncertainty that is not that of the simulation.
TEST(ReadingsOfDime, AreRoundedAndStateTheirNoise) {
  const Model model = MeasuringRobot();
  Random random(2);
  const DimeNoise noise;
  const auto readings = ReadDime(model, Eigen::VectorXd::Zero(25), noise, &random);
  ASSERT_TRUE(readings.ok()) << readings.status();
  ASSERT_EQ(readings->size(), 81u);
  const std::vector<DimePose> dime = Dime();
  for (size_t i = 0; i < 81; ++i) {
    const Reading& reading = (*readings)[i];
    EXPECT_EQ(reading.X_MT.p, dime[i].hole.p_M);
    EXPECT_EQ(reading.axis_M, dime[i].hole.axis_M);
    const Eigen::ArrayXd steps = reading.q.array() / (0.018 * testing::kDeg);
    EXPECT_LT((steps - steps.round()).abs().maxCoeff(), 1e-9);
    EXPECT_NEAR(reading.joint_sd(2), 0.018 * testing::kDeg / std::sqrt(12.0), 1e-15);
  }
}

}  // namespace
}  // namespace truepose
