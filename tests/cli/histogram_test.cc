#include "client/cli/histogram.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "client/cli/table.h"

namespace truepose::cli {
namespace {

using ::testing::ElementsAre;

// Would catch steps that are not 1, 2, 5 or too many bins.
TEST(BinWidth, IsOneTwoOrFiveTimesAPowerOfTen) {
  EXPECT_DOUBLE_EQ(BinWidth(1.5, 16), 0.1);
  EXPECT_DOUBLE_EQ(BinWidth(1.61, 16), 0.2);
  EXPECT_DOUBLE_EQ(BinWidth(0.033, 16), 0.005);
  EXPECT_DOUBLE_EQ(BinWidth(16.0, 16), 1.0);
  EXPECT_DOUBLE_EQ(BinWidth(500.0, 16), 50.0);
}

// Would catch a division by zero or an endless loop on residuals of a noise-free simulation.
TEST(BinWidth, IsOneWithoutAPositiveLargestValue) {
  EXPECT_EQ(BinWidth(0.0, 16), 1.0);
  EXPECT_EQ(BinWidth(std::numeric_limits<double>::quiet_NaN(), 16), 1.0);
  EXPECT_EQ(BinWidth(std::numeric_limits<double>::infinity(), 16), 1.0);
}

// Would catch lost values at the edges and an index out of the bins.
TEST(CountBins, PutsEdgesUpAndEverythingBeyondIntoTheLast) {
  EXPECT_THAT(CountBins({0.0, 0.99, 1.0, 2.0, 3.0, 1e300}, 1.0, 3), ElementsAre(2, 1, 3));
  EXPECT_THAT(CountBins({std::nan(""), -1.0}, 1.0, 2), ElementsAre(1, 0));
}

// Would catch a rare outlier that disappears from the picture.
TEST(Bar, ShowsOneOfThousands) {
  EXPECT_EQ(Bar(1, 10000, 10, false), "#");
  EXPECT_EQ(Bar(1, 10000, 10, true), "▏");
  EXPECT_EQ(Bar(0, 10000, 10, true), "");
  EXPECT_EQ(Bar(7, 7, 3, false), "###");
  EXPECT_EQ(DisplayWidth(Bar(7, 7, 3, true)), 3u);
  EXPECT_EQ(Bar(0, 0, 3, true), "");
}

// Would catch swapped columns, a wrong scale between them, a value on an edge in the bin below, and
// anything but ASCII in ASCII.
TEST(BeforeAfterHistogram, DrawsBothOnOneScale) {
  EXPECT_EQ(BeforeAfterHistogram({2.9, 4.0, 3.9}, {0.1, 0.1, 0.3, 1.0}, "mm", false),
            R"(  from mm  before                    after
      0.0       0                        3  ########################
      0.5       0                        0
      1.0       0                        1  ########
      1.5       0                        0
      2.0       0                        0
      2.5       1  ########              0
      3.0       0                        0
      3.5       2  ################      0
)");
}

// Would catch an edge that floating point moves: 0.3 / 0.1 is below 3.
TEST(CountBins, TakesDecimalEdgesAsPeopleDo) {
  EXPECT_THAT(CountBins({0.1, 0.2, 0.3, 0.6, 0.7}, 0.1, 8), ElementsAre(0, 1, 1, 1, 0, 0, 1, 1));
}

TEST(BeforeAfterHistogram, IsEmptyWithoutValues) {
  EXPECT_EQ(BeforeAfterHistogram({}, {}, "mm", true), "");
}

}  // namespace
}  // namespace truepose::cli
