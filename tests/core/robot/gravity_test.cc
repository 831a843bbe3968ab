#include "core/robot/gravity.h"

#include <gtest/gtest.h>

#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

double Energy(const Robot& robot, const std::vector<LinkMass>& masses, const Eigen::VectorXd& q) {
  double energy = 0;
  for (const LinkMass& mass : masses) {
    Chain part;
    for (const ElementaryTransform& element : robot.chain()) {
      part.push_back(element);
      if (element.joint == mass.joint) break;
    }
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(q.size());
    const Eigen::Vector3d p =
        Forward<double>(part, q.data(), nullptr) *
        (Inverse(Forward<double>(part, zero.data(), nullptr)) * mass.centre_B);
    energy += mass.mass_kg * 9.80665 * p.z();
  }
  return energy;
}

// The load is minus the slope of the potential energy, for turning and sliding joints.
TEST(Gravity, IsTheSlopeOfTheEnergy) {
  Random random(3);
  for (const Robot& robot : {testing::Ur10(), testing::Stanford()}) {
    const std::vector<LinkMass> masses = {
        {1, 12.9, {-0.3, 0.05, 0.13}}, {2, 4.3, {-0.9, 0.1, 0.2}}, {5, 1.2, {-1.1, 0.3, 0.1}}};
    const Eigen::VectorXd q = testing::RandomVector(6, 1.5, &random);
    const Eigen::VectorXd load = GravityLoad(robot.chain(), masses, q);
    for (int j = 0; j < 6; ++j) {
      const double h = 1e-6;
      Eigen::VectorXd plus = q, minus = q;
      plus(j) += h;
      minus(j) -= h;
      const double slope = (Energy(robot, masses, plus) - Energy(robot, masses, minus)) / (2 * h);
      EXPECT_NEAR(load(j), -slope, 1e-6 * (1 + std::abs(slope))) << "joint " << j + 1;
    }
  }
}

// A vertical first axis carries no weight; a horizontal arm of 1 m and 10 kg carries 98 N m.
TEST(Gravity, OfAPlainArm) {
  const Robot ur10 = testing::Ur10();
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(6);
  const Eigen::VectorXd load = GravityLoad(ur10.chain(), {{1, 10, {-1, 0, 0.1273}}}, zero);
  EXPECT_NEAR(load(0), 0, 1e-12);
  EXPECT_NEAR(std::abs(load(1)), 98.0665, 1e-9);
  EXPECT_EQ(load(5), 0) << "a joint beyond the mass carries nothing";
}

}  // namespace
}  // namespace truepose
