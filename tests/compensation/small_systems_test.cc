// The small pieces of arithmetic under a correction by table.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "compensation/above.h"
#include "compensation/inverse6.h"
#include "compensation/sines.h"
#include "core/base/random.h"

namespace truepose::compensation {
namespace {

using Six = Eigen::Matrix<double, 6, 6>;

Six RandomMatrix(Random* random) {
  Six matrix;
  for (double& value : matrix.reshaped()) value = random->Uniform(-1, 1);
  return matrix;
}

// With zeros on the diagonal as well, where elimination without exchanges fails. Its rounding goes
// with the square of the condition; a wrong term is an error of the order of 1.
TEST(Inverse6, SolvesAnyMatrix) {
  Random random(41);
  for (int trial = 0; trial < 200; ++trial) {
    Six matrix = RandomMatrix(&random);
    if (trial % 2 == 0) matrix.diagonal().setZero();
    const Eigen::Matrix<double, 6, 1> expected = RandomMatrix(&random).col(0);
    Inverse6 inverse;
    ASSERT_TRUE(inverse.Set(matrix));
    Eigen::Matrix<double, 6, 1> found;
    inverse.Solve(matrix * expected, found.data());
    const double condition = matrix.norm() * matrix.inverse().norm();
    EXPECT_LT((found - expected).norm(), 1e-14 * condition * condition);
    EXPECT_NEAR(inverse.SquaredNorm() / matrix.inverse().squaredNorm(), 1,
                1e-14 * condition * condition);
  }
}

TEST(Inverse6, RefusesWhatHasNoInverse) {
  Inverse6 inverse;
  Six matrix = Six::Identity();
  matrix(3, 3) = 0;
  EXPECT_FALSE(inverse.Set(matrix));
  matrix(3, 3) = NAN;
  EXPECT_FALSE(inverse.Set(matrix));
  matrix = Six::Identity();
  matrix(0, 0) = 0;
  EXPECT_FALSE(inverse.Set(matrix));
}

// What is singular to rounding may pass, but its solution is seen to be none. Would catch a
// residual that is always small, or of the transposed matrix.
TEST(Inverse6, SaysWhatItHasNotSolved) {
  Random random(44);
  int passed = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Six matrix = RandomMatrix(&random);
    const Eigen::Matrix<double, 6, 1> b = RandomMatrix(&random).col(0);
    double x[6];
    Inverse6 inverse;
    ASSERT_TRUE(inverse.Set(matrix));
    inverse.Solve(b, x);
    const double condition = matrix.norm() * matrix.inverse().norm();
    EXPECT_LT(inverse.Unsolved(b, x).norm(), 1e-14 * condition * condition);
    matrix.row(4) = matrix.row(0) + 0.5 * matrix.row(1) - matrix.row(2);
    if (!inverse.Set(matrix)) continue;
    ++passed;
    inverse.Solve(b, x);
    const Eigen::Matrix<double, 6, 1> left =
        b - matrix * Eigen::Map<Eigen::Matrix<double, 6, 1>>(x);
    EXPECT_LT((inverse.Unsolved(b, x) - left).norm(), 1e-12 * (1 + left.norm()));
    EXPECT_GT(inverse.Unsolved(b, x).norm(), 1e-3);
  }
  EXPECT_GT(passed, 50);
}

// Against singular values that are found; both sides of the bound, closely.
TEST(SingularValuesAreAbove, DecidesAsTheSmallestOne) {
  Random random(42);
  for (int trial = 0; trial < 200; ++trial) {
    const Six matrix = RandomMatrix(&random);
    const double least = matrix.jacobiSvd().singularValues()(5);
    EXPECT_TRUE(SingularValuesAreAbove(matrix, least - 1e-6));
    EXPECT_FALSE(SingularValuesAreAbove(matrix, least + 1e-6));
  }
}

// Every quadrant, both signs, few and many turns, and the corners between octants.
TEST(SinesOfSix, AreThoseOfTheLibrary) {
  Random random(43);
  for (int trial = 0; trial < 60000; ++trial) {
    const double range = trial % 3 == 0 ? kLargestAngle : trial % 3 == 1 ? 7 : 0.9;
    double angle[6], sine[6], cosine[6];
    for (int i = 0; i < 6; ++i) angle[i] = random.Uniform(-range, range);
    angle[5] = 0.78539816339744828 * static_cast<double>(random.Below(17)) - 6.2831853071795862;
    SinesOfSix(angle, sine, cosine);
    for (int i = 0; i < 6; ++i) {
      ASSERT_NEAR(sine[i], std::sin(angle[i]), 3e-16) << angle[i];
      ASSERT_NEAR(cosine[i], std::cos(angle[i]), 3e-16) << angle[i];
    }
  }
}

}  // namespace
}  // namespace truepose::compensation
