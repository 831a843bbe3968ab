#include "server/jobs/time_left.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace truepose::jobs {
namespace {

// Catches an estimate the wrong way round, or in another unit.
TEST(TimeLeft, TheRestGoesOnAsFast) {
  EXPECT_DOUBLE_EQ(*SecondsLeft(absl::Seconds(30), 0.25), 90);
  EXPECT_DOUBLE_EQ(*SecondsLeft(absl::Milliseconds(500), 0.5), 0.5);
  EXPECT_EQ(*SecondsLeft(absl::Seconds(30), 1), 0);
  EXPECT_EQ(*SecondsLeft(absl::Seconds(30), 1.5), 0) << "never negative";
}

// Catches a number where nothing is known.
TEST(TimeLeft, NothingIsSaidWithoutKnowing) {
  EXPECT_FALSE(SecondsLeft(absl::Seconds(30), 0).has_value());
  EXPECT_FALSE(SecondsLeft(absl::Seconds(30), 0.01).has_value());
  EXPECT_FALSE(SecondsLeft(absl::ZeroDuration(), 0.5).has_value());
  EXPECT_FALSE(SecondsLeft(absl::Seconds(1), std::numeric_limits<double>::quiet_NaN()).has_value());
}

}  // namespace
}  // namespace truepose::jobs
