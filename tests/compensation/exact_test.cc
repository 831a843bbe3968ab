// Forward(Compensate(X)) == X, for every kind of arm, or a status that says why not.
#include "compensation/exact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "compensation/singularity.h"
#include "tests/compensation/arms.h"

namespace truepose::compensation {
namespace {

using testing::AllArms;
using testing::NamedArm;

// What is asked of exact compensation farther than 1e-3 from a singularity.
constexpr double kExact = 1e-9;

Eigen::VectorXd RandomJoints(const Arm& arm, Random* random) {
  return truepose::testing::RandomVector(arm.nominal.joints, 1.5, random);
}

struct Left {
  double position_m, rotation_rad;
};

// By core's Forward of the model, not by the runtime's own: a common mistake would not show.
Left LeftAt(const NamedArm& named, const Pose& desired, const Correction& correction) {
  const Eigen::VectorXd q =
      Eigen::Map<const Eigen::VectorXd>(correction.q.data(), named.robot.joint_count());
  const Pose X = Forward(named.model, named.robot.joint_map().ToChain(q), named.lambda);
  return {(X.p - desired.p).norm(), LogRotation<double>(desired.R * X.R.transpose()).norm()};
}

void ExpectReachedOrSaid(const NamedArm& named, const Eigen::VectorXd& q) {
  const Pose desired = NominalFlange(named.arm, q.data());
  const Correction correction = CorrectJoints(named.arm, q.data(), {});
  const Left left = LeftAt(named, desired, correction);
  EXPECT_NEAR(left.position_m, correction.position_error_m, 1e-12) << named.name;
  EXPECT_NEAR(left.rotation_rad, correction.rotation_error_rad, 1e-12) << named.name;
  const double sigma =
      SmallestSingularValue(named.arm, q.data(), CharacteristicLength(named.arm.nominal));
  if (correction.outcome == Outcome::kOk) {
    EXPECT_LT(left.position_m, kExact) << named.name;
    EXPECT_LT(left.rotation_rad, kExact) << named.name;
  } else {
    // Errors of 1 mrad and 1 mm move the place by some 1e-2 of its distance to a singularity only
    // when that is near.
    EXPECT_LT(sigma, 0.05) << named.name << ": " << Name(correction.outcome);
  }
}

TEST(Exact, SixJointsAndMoreReachWhatTheyShouldOrSayWhyNot) {
  for (const NamedArm& named : AllArms()) {
    if (named.arm.nominal.joints < 6) continue;
    Random random(11);
    for (int draw = 0; draw < 300; ++draw)
      ExpectReachedOrSaid(named, RandomJoints(named.arm, &random));
  }
}

}  // namespace
}  // namespace truepose::compensation
