// The simplex by itself, on functions whose minimum is known.
#include "core/identification/nelder_mead.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace truepose {
namespace {

const std::function<bool()> kNever = [] { return false; };

double Sphere(const Eigen::VectorXd& x) { return (x.array() - 3).square().sum(); }

// In 30 dimensions the usual coefficients stall far from here.
TEST(NelderMead, ThirtyDimensions) {
  const NelderMeadResult result =
      NelderMead(Sphere, Eigen::VectorXd::Zero(30), {3, 1e-6, 5'000}, kNever);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(result.value, 1e-3);
  EXPECT_EQ(result.value, Sphere(result.point));
}

TEST(NelderMead, OneDimension) {
  const NelderMeadResult result =
      NelderMead(Sphere, Eigen::VectorXd::Zero(1), {1, 1e-14, 500}, kNever);
  EXPECT_TRUE(result.converged);
  EXPECT_NEAR(result.point(0), 3, 1e-6);
}

// A valley that bends: catches a contraction or a shrinkage that goes the wrong way.
TEST(NelderMead, CurvedValley) {
  const auto valley = [](const Eigen::VectorXd& x) {
    return 100 * std::pow(x(1) - x(0) * x(0), 2) + std::pow(1 - x(0), 2);
  };
  const NelderMeadResult result =
      NelderMead(valley, Eigen::Vector2d(-1.2, 1), {0.5, 1e-14, 2'000}, kNever);
  EXPECT_TRUE(result.converged);
  EXPECT_NEAR(result.point(0), 1, 1e-5);
  EXPECT_NEAR(result.point(1), 1, 1e-5);
}

// What counts as an evaluation is a call. Every value is worse than those before, so each step
// takes all that a step can take, a shrinkage, and must still not pass the limit.
TEST(NelderMead, LimitOfEvaluations) {
  for (int limit = 12; limit <= 50; ++limit) {
    int calls = 0;
    const auto rugged = [&](const Eigen::VectorXd&) { return static_cast<double>(++calls); };
    const NelderMeadResult result =
        NelderMead(rugged, Eigen::VectorXd::Zero(5), {1, 0, limit}, kNever);
    EXPECT_FALSE(result.converged);
    EXPECT_EQ(result.evaluations, calls);
    EXPECT_LE(calls, limit);
    EXPECT_GT(calls, limit - 8) << "evaluations left unused";
  }
}

// Half of the space has no value: a vertex there must not win every comparison or poison the sort.
TEST(NelderMead, ValuesThatAreNotFiniteAreWorst) {
  const auto half = [](const Eigen::VectorXd& x) {
    return x(0) > 4 ? std::numeric_limits<double>::quiet_NaN() : Sphere(x);
  };
  const NelderMeadResult result =
      NelderMead(half, Eigen::VectorXd::Zero(4), {5, 1e-10, 3'000}, kNever);
  EXPECT_TRUE(result.converged);
  EXPECT_LT(result.value, 1e-6);
}

TEST(NelderMead, StopKeepsTheBest) {
  int asked = 0;
  const NelderMeadResult result =
      NelderMead(Sphere, Eigen::VectorXd::Zero(5), {1, 0, 5'000}, [&] { return ++asked > 10; });
  EXPECT_FALSE(result.converged);
  EXPECT_LT(result.evaluations, 40);
  EXPECT_LT(result.value, Sphere(Eigen::VectorXd::Zero(5)));
}

}  // namespace
}  // namespace truepose
