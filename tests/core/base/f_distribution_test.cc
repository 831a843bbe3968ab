#include "core/base/f_distribution.h"

#include <gtest/gtest.h>

#include "core/base/chi_square.h"

namespace truepose {
namespace {

// Quantiles from printed tables, to their last digit.
TEST(FDistribution, PrintedQuantiles) {
  EXPECT_NEAR(FSurvival(3.33, 5, 10), 0.05, 2e-4);
  EXPECT_NEAR(FSurvival(5.64, 5, 10), 0.01, 3e-5);
  EXPECT_NEAR(FSurvival(4.96, 1, 10), 0.05, 2e-4);
}

// Swapped degrees of freedom would show here.
TEST(FDistribution, ReciprocalAndMedian) {
  EXPECT_NEAR(FSurvival(2.5, 3, 7), 1 - FSurvival(1 / 2.5, 7, 3), 1e-10);
  EXPECT_NEAR(FSurvival(1, 9, 9), 0.5, 1e-10);
  EXPECT_EQ(FSurvival(0, 4, 4), 1);
  EXPECT_EQ(FSurvival(-1, 4, 4), 1);
}

TEST(FDistribution, IsChiSquareWhenTheScaleIsSure) {
  for (double x : {0.5, 1.0, 2.0, 4.0})
    EXPECT_NEAR(FSurvival(x, 6, 1e7), ChiSquareSurvival(6 * x, 6), 1e-6);
}

}  // namespace
}  // namespace truepose
