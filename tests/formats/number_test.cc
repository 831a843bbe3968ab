#include "formats/number.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

#include "gtest/gtest.h"

namespace truepose::formats {
namespace {

TEST(NumberTest, ReadsWholeNumbersOfEveryForm) {
  EXPECT_EQ(ParseNumber("-1.5"), -1.5);
  EXPECT_EQ(ParseNumber("+1.5"), 1.5);
  EXPECT_EQ(ParseNumber("1e-3"), 0.001);
  EXPECT_EQ(ParseNumber("7"), 7.0);
}

// Catches: a prefix taken for the number, hexadecimal, a sign twice, blanks.
TEST(NumberTest, RejectsWhatIsNoNumber) {
  for (const char* text : {"", "abc", "1.5x", "1 2", "0x10", "+-1", "--1", "+", "1,5", "1e", "."}) {
    EXPECT_FALSE(ParseNumber(text).has_value()) << text;
  }
}

// Catches: not-a-number and infinity that reach the estimator.
TEST(NumberTest, RejectsWhatIsNotFinite) {
  for (const char* text : {"nan", "NaN", "-nan", "inf", "-Infinity", "1e999"}) {
    EXPECT_FALSE(ParseNumber(text).has_value()) << text;
  }
}

TEST(NumberTest, ReadsADecimalCommaOnlyWhereItIsExpected) {
  EXPECT_EQ(ParseNumber("1,5", true), 1.5);
  EXPECT_EQ(ParseNumber("1.5", true), 1.5);
  EXPECT_FALSE(ParseNumber("1.234,5", true).has_value());
  EXPECT_FALSE(ParseNumber("1,234,5", true).has_value());
}

// Catches: digits lost in writing. Bit patterns over all magnitudes.
TEST(NumberTest, WritesWhatReadsBackAsTheSameBits) {
  std::mt19937_64 random(20240501);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isnormal(value)) continue;
    const auto read = ParseNumber(FormatNumber(value));
    ASSERT_TRUE(read.has_value()) << FormatNumber(value);
    ASSERT_EQ(std::bit_cast<uint64_t>(*read), std::bit_cast<uint64_t>(value));
  }
}

}  // namespace
}  // namespace truepose::formats
