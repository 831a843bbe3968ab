// Real roots of trigonometric polynomials and of polynomials.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "compensation/polynomial.h"
#include "compensation/trigonometric.h"
#include "tests/core/testing/robots.h"

namespace truepose::compensation {
namespace {

using truepose::testing::RandomVector;

constexpr double kPi = std::numbers::pi;

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

// (x - r)(x - s)
Polynomial WithRoots(double r, double s) { return {r * s, -r - s, 1}; }

double DistanceTo(const Roots& roots, double x) {
  double nearest = 1e9;
  for (int i = 0; i < roots.count; ++i) nearest = std::min(nearest, std::abs(roots.q[i] - x));
  return nearest;
}

// Degrees one to four, and four with leading terms that are rounding only. Would catch a wrong
// coefficient of the half-tangent, a root lost to a degree taken for another, roots at infinity
// handed out.
TEST(Polynomial, RealRootsOfEveryDegree) {
  Random random(92);
  for (int draw = 0; draw < 200; ++draw) {
    const Eigen::VectorXd r = RandomVector(4, 3, &random);
    const double noise = draw % 2 == 0 ? 0 : 1e-15;
    const Polynomial linear = {-r(0), 1, noise, -noise, noise};
    const Polynomial second = WithRoots(r(0), r(1));
    const Polynomial third = second * Polynomial{-r(2), 1} + noise * Polynomial{0, 0, 0, 0, 1};
    const Polynomial fourth = second * WithRoots(r(2), r(3));
    int degree = 0;
    for (const Polynomial& f : {linear, second, third, fourth}) {
      ++degree;
      const Roots roots = RootsOf(-2.5 * f);
      EXPECT_EQ(roots.count, degree) << draw;
      // Two that nearly merge are right to the root of the last bits, three to the cubic root.
      for (int i = 0; i < degree; ++i) EXPECT_LT(DistanceTo(roots, r(i)), 1e-4) << degree;
      for (int i = 0; i < roots.count; ++i) EXPECT_LT(std::abs(f.At(roots.q[i])), 1e-10) << degree;
    }
  }
}

// Would catch a small root lost in the difference of two large numbers.
TEST(Polynomial, SmallRootBesideALargeOne) {
  for (const double sign : {1.0, -1.0}) {
    const Roots roots = RootsOf(WithRoots(sign * 1e-9, sign * 1e3));
    ASSERT_EQ(roots.count, 2);
    EXPECT_LT(DistanceTo(roots, sign * 1e-9), 1e-22);
    EXPECT_LT(DistanceTo(roots, sign * 1e3), 1e-9);
  }
}

// The place of closest approach where two have just merged, and none where they are gone.
TEST(Polynomial, MergedRoots) {
  const Polynomial merged = WithRoots(0.7, 0.7) + Polynomial{1e-6};
  EXPECT_EQ(RootsOf(merged).count, 1);
  EXPECT_LT(DistanceTo(RootsOf(merged), 0.7), 1e-12);
  const Roots of_four = RootsOf(merged * WithRoots(-1.5, 2));
  EXPECT_LT(DistanceTo(of_four, 0.7), 1e-2);
  EXPECT_LT(DistanceTo(of_four, -1.5), 1e-9);
  EXPECT_EQ(RootsOf(WithRoots(0.7, 0.7) + Polynomial{1e-3}).count, 0);
  EXPECT_EQ(RootsOf((WithRoots(0.7, 0.7) + Polynomial{1e-2}) * WithRoots(-1.5, 2)).count, 2);
}

TEST(Polynomial, ConstantsHaveNone) {
  EXPECT_EQ(RootsOf(Polynomial{}).count, 0);
  EXPECT_EQ(RootsOf(Polynomial{3}).count, 0);
  EXPECT_EQ(RootsOf(Polynomial{3, 1e-15}).count, 0);
  EXPECT_EQ(RootsOf(Polynomial{NAN, 1, 1}).count, 0);
}

}  // namespace
}  // namespace truepose::compensation
