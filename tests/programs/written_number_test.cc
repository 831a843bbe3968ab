#include "programs/written_number.h"

#include <gtest/gtest.h>

#include <numbers>

namespace truepose::programs {
namespace {

// Would catch an exponent, a minus before nothing, and a program that was more precise than its
// correction.
TEST(WrittenNumberTest, DecimalsAreAtLeastThoseThatStoodThere) {
  EXPECT_EQ(WriteNumber(1.0, Unit::kRadOrM, "1"), "1.00000000");
  EXPECT_EQ(WriteNumber(-90.0000004, Unit::kDegOrMm, "-90.0"), "-90.000000");
  EXPECT_EQ(WriteNumber(0.5, Unit::kDegOrMm, "0.123456789"), "0.500000000");
  EXPECT_EQ(WriteNumber(0.5, Unit::kDegOrMm, "0.12345678901234567890"), "0.5000000000");
  EXPECT_EQ(WriteNumber(-1e-9, Unit::kRadOrM, "0"), "0.00000000");
  EXPECT_EQ(WriteNumber(0.5, Unit::kRadOrM, "-0.1"), "0.50000000");
  EXPECT_EQ(WriteNumber(0.5, Unit::kRadOrM, "-0.1", true), "+0.50000000");
  EXPECT_EQ(WriteNumber(0.5, Unit::kRadOrM, "+0.1"), "+0.50000000");
  EXPECT_EQ(WriteNumber(-0.5, Unit::kRadOrM, "+0.1"), "-0.50000000");
  EXPECT_EQ(WriteNumber(1e12, Unit::kDegreesFunction, "1E12"), "1000000000000.000000");
  EXPECT_EQ(WriteNumber(1.0, Unit::kDegOrMm, "1.23E1"), "1.000000");
}

TEST(WrittenNumberTest, UnitsInSi) {
  EXPECT_EQ(SiPerUnit(Unit::kRadOrM, false), 1.0);
  EXPECT_EQ(SiPerUnit(Unit::kRadOrM, true), 1.0);
  EXPECT_EQ(SiPerUnit(Unit::kDegOrMm, false), std::numbers::pi / 180.0);
  EXPECT_EQ(SiPerUnit(Unit::kDegOrMm, true), 1e-3);
  EXPECT_EQ(SiPerUnit(Unit::kDegreesFunction, true), 0.0);
}

}  // namespace
}  // namespace truepose::programs
