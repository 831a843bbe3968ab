#include "core/base/chi_square.h"

#include <gtest/gtest.h>

#include <cmath>

namespace truepose {
namespace {

// Values of printed tables: a wrong degree of freedom or a mixed up tail shows at once.
TEST(ChiSquare, Tables) {
  EXPECT_NEAR(ChiSquareQuantile(0.95, 1), 3.841459, 1e-6);
  EXPECT_NEAR(ChiSquareQuantile(0.95, 3), 7.814728, 1e-6);
  EXPECT_NEAR(ChiSquareQuantile(0.99, 6), 16.811894, 1e-6);
  EXPECT_NEAR(ChiSquareSurvival(3.841459, 1), 0.05, 1e-7);
  // Two degrees of freedom have a closed form.
  EXPECT_NEAR(ChiSquareSurvival(5, 2), std::exp(-2.5), 1e-14);
}

TEST(ChiSquare, EndsAndInverse) {
  EXPECT_EQ(ChiSquareSurvival(0, 4), 1);
  EXPECT_EQ(ChiSquareSurvival(-1, 4), 1);
  EXPECT_LT(ChiSquareSurvival(400, 3), 1e-80);
  for (int k : {1, 2, 5, 30}) {
    for (double p : {0.01, 0.5, 0.999, 1 - 1e-6})
      EXPECT_NEAR(ChiSquareSurvival(ChiSquareQuantile(p, k), k), 1 - p, 1e-11);
  }
}

}  // namespace
}  // namespace truepose
