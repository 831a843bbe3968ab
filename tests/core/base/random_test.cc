#include "core/base/random.h"

#include <gtest/gtest.h>

namespace truepose {
namespace {

// Splits and simulated sessions are promised to be the same on every platform and for ever: known
// answers, from a separate implementation of mt19937_64 with its published constants.
TEST(Random, KnownAnswers) {
  EXPECT_EQ(Random(3).Below(UINT64_MAX), 10307413207671831467u);
  EXPECT_EQ(Random(3).Uniform(),
            static_cast<double>(10307413207671831467u >> 11) / 9007199254740992.0);
}

TEST(Random, BelowCoversEveryValueEvenly) {
  Random random(1);
  int counts[7] = {};
  for (int i = 0; i < 70000; ++i) ++counts[random.Below(7)];
  // 10,000 each with a deviation of 93; 5 sigma.
  for (int count : counts) EXPECT_NEAR(count, 10000, 465);
}

TEST(Random, RangeIsRespected) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const double v = random.Uniform(-2, 5);
    EXPECT_GE(v, -2);
    EXPECT_LT(v, 5);
  }
}

// Mean 0 and variance 1 of 100,000 draws, within 5 of their deviations.
TEST(Random, NormalHasMeanZeroAndVarianceOne) {
  Random random(4);
  double sum = 0, squares = 0;
  const int n = 100000;
  for (int i = 0; i < n; ++i) {
    const double v = random.Normal();
    sum += v;
    squares += v * v;
  }
  EXPECT_NEAR(sum / n, 0, 0.016);
  EXPECT_NEAR(squares / n, 1, 0.023);
}

}  // namespace
}  // namespace truepose
