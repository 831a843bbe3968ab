// The turns of a wrist, also where it is straight.
#include "compensation/wrist_turns.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/random.h"

namespace truepose::compensation {
namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Matrix3d Turn(double angle, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

Eigen::Matrix3d TurnZ(double angle) { return Turn(angle, Eigen::Vector3d::UnitZ()); }

// A Z_5(0) B has its axes 4 and 6 as near as they come.
struct Wrist {
  Eigen::Matrix3d A, B;
};

Wrist RandomWrist(double alpha, double beta, Random* random) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  return {TurnZ(random->Uniform(-3, 3)) * Turn(alpha, x),
          Turn(-beta, x) * TurnZ(random->Uniform(-3, 3))};
}

Eigen::Matrix3d Turned(const Wrist& wrist, const std::array<double, 3>& q) {
  return TurnZ(q[0]) * wrist.A * TurnZ(q[1]) * wrist.B * TurnZ(q[2]);
}

double Apart(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  double largest = 0;
  for (size_t i = 0; i < 3; ++i)
    largest = std::max(largest, std::abs(std::remainder(a[i] - b[i], 2 * kPi)));
  return largest;
}

// Every solution is one but those with the reference's q4, which are as wrong as the wrist is
// straight; and the turns are among them. @param resolution how well M tells q4.
void ExpectSolved(const Wrist& wrist, const std::array<double, 3>& q, double resolution) {
  const Eigen::Matrix3d M = Turned(wrist, q);
  const double reference = 2;
  const WristTurns turns = WristTurnsOf(wrist.A, wrist.B, M, reference);
  double nearest = 1e9;
  for (int i = 0; i < turns.count; ++i) {
    const bool by_reference = turns.q[i][0] == reference;
    const double bound = by_reference ? 4e-6 : 2e-14;  // some forty roundings
    EXPECT_LT((Turned(wrist, turns.q[i]) - M).norm(), bound) << q[1];
    nearest = std::min(nearest, Apart(turns.q[i], q));
  }
  EXPECT_LT(nearest, 1e-14 / resolution) << q[1];
}

TEST(WristTurns, AnyAnglesBetweenTheAxes) {
  Random random(84);
  for (int draw = 0; draw < 300; ++draw) {
    const Wrist wrist = RandomWrist(random.Uniform(0.6, 2.5), random.Uniform(0.6, 2.5), &random);
    const double q5 = random.Uniform(0.05, 3);  // away from where both solutions meet
    for (const double sign : {1.0, -1.0}) {
      const std::array<double, 3> q = {random.Uniform(-3, 3), sign * q5, random.Uniform(-3, 3)};
      ExpectSolved(wrist, q, 1e-2);
      EXPECT_EQ(WristTurnsOf(wrist.A, wrist.B, Turned(wrist, q), 0).count, 2);
    }
  }
}

// As straight as can be, from either end, as equal angles to the middle axis allow. Would catch q5
// by way of its cosine, which is right to 1e-8 here: M would be missed by as much and q4 be noise.
TEST(WristTurns, StraightOnesAsWell) {
  Random random(85);
  for (const double bent : {1e-3, 1e-5, 1e-7, 1e-9, 1e-11}) {
    for (int draw = 0; draw < 20; ++draw) {
      const double alpha = random.Uniform(0.6, 2.5);
      const std::array<double, 3> stretched = {0.7, bent, -0.4}, folded = {0.7, kPi - bent, -0.4};
      const Wrist wrist = RandomWrist(alpha, alpha, &random);
      ExpectSolved(wrist, stretched, 0.2 * bent);
      ExpectSolved(RandomWrist(alpha, kPi - alpha, &random), folded, 0.2 * bent);
    }
  }
}

// No q4 is told from another, stretched or folded: only that of the reference, not one of noise.
TEST(WristTurns, StraightToTheLastBit) {
  Random random(86);
  for (int draw = 0; draw < 20; ++draw) {
    const double alpha = random.Uniform(0.6, 2.5), folded = draw % 2 == 0 ? 0 : kPi;
    const Wrist wrist = RandomWrist(alpha, folded == 0 ? alpha : kPi - alpha, &random);
    const std::array<double, 3> q = {0.7, folded, -0.4};
    const WristTurns turns = WristTurnsOf(wrist.A, wrist.B, Turned(wrist, q), q[0]);
    ASSERT_GE(turns.count, 1);
    for (int i = 0; i < turns.count; ++i) EXPECT_LT(Apart(turns.q[i], q), 1e-12);
  }
}

// Beyond what the axes' angles allow there is nothing; just beyond it the place next to it.
TEST(WristTurns, OutOfReach) {
  Random random(87);
  const Wrist wrist = RandomWrist(1.0, 0.7, &random);  // axes 4 and 6 at 0.3 to 1.7 rad
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  for (const double angle : {0.1, 0.29, 1.71, 3.0})
    EXPECT_EQ(WristTurnsOf(wrist.A, wrist.B, Turn(angle, x), 0).count, 0) << angle;
  for (const double angle : {0.3 - 1e-6, 1.7 + 1e-6}) {
    const WristTurns turns = WristTurnsOf(wrist.A, wrist.B, Turn(angle, x), 0);
    ASSERT_EQ(turns.count, angle < 1 ? 1 : 2) << angle;
    EXPECT_LT((Turned(wrist, turns.q[0]) - Turn(angle, x)).norm(), 1e-5) << angle;
  }
}

}  // namespace
}  // namespace truepose::compensation
