#include "formats/unit.h"

#include <numbers>
#include <random>

#include "formats/number.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace truepose::formats {
namespace {

using ::testing::ElementsAre;

double ToSi(Dimension dimension, std::string_view symbol, double value) {
  return FindUnit(dimension, symbol)->to_si(value);
}

// Catches: a factor that is inverted, or right angles that miss pi / 2 by a bit.
TEST(UnitTest, ConvertsToSi) {
  EXPECT_EQ(ToSi(Dimension::kAngle, "deg", 90), std::numbers::pi / 2);
  EXPECT_EQ(ToSi(Dimension::kAngle, "deg", -180), -std::numbers::pi);
  EXPECT_EQ(ToSi(Dimension::kAngle, "rad", 1.5), 1.5);
  EXPECT_EQ(ToSi(Dimension::kLength, "mm", 127.3), 0.1273);
  EXPECT_EQ(ToSi(Dimension::kLength, "m", 2), 2);
  EXPECT_EQ(ToSi(Dimension::kTemperature, "C", 21.5), 21.5);
  EXPECT_EQ(ToSi(Dimension::kTorque, "Nm", 3), 3);
}

// Catches: a unit of one dimension taken for another.
TEST(UnitTest, KnowsUnitsByDimension) {
  EXPECT_EQ(FindUnit(Dimension::kAngle, "mm"), nullptr);
  EXPECT_EQ(FindUnit(Dimension::kLength, "in"), nullptr);
  EXPECT_EQ(FindUnit(Dimension::kLength, "MM"), nullptr);
  EXPECT_THAT(NamesWithUnits("x", Dimension::kLength), ElementsAre("x_mm", "x_m"));
  EXPECT_THAT(NamesWithUnits("qx", Dimension::kNone), ElementsAre("qx"));
}

TEST(UnitTest, ShowsRoundValuesInPeoplesUnits) {
  EXPECT_EQ(MeasureForPeople(0.1273, Dimension::kLength).digits, "127.3");
  EXPECT_EQ(MeasureForPeople(0.1273, Dimension::kLength).symbol, "mm");
  EXPECT_EQ(MeasureForPeople(-std::numbers::pi / 2, Dimension::kAngle).digits, "-90");
  EXPECT_EQ(MeasureForPeople(1.0 / 3, Dimension::kLength).symbol, "m");
}

// Catches: a value that changes when it is written and read again.
TEST(UnitTest, ShownValuesReadBackAsTheSameBits) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> value(-4, 4);
  for (int i = 0; i < 20000; ++i) {
    const double si = i % 2 == 0 ? value(random) : FindUnit(Dimension::kLength, "mm")->to_si(i);
    for (const Dimension dimension : {Dimension::kAngle, Dimension::kLength}) {
      const Measure shown = MeasureForPeople(si, dimension);
      ASSERT_EQ(ToSi(dimension, shown.symbol, *ParseNumber(shown.digits)), si);
    }
  }
}

}  // namespace
}  // namespace truepose::formats
