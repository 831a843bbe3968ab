// Joint effects of a real robot: taken where they help, left where they would hurt.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <string>

#include "tests/golden/long_run.h"
#include "tests/golden/measured.h"

namespace truepose {
namespace {

// Control RMS in mm with and without effects on the same rows.
struct Pair {
  double geometry_mm, effects_mm;
  int groups;  // of effects that were taken
  double Ratio() const { return effects_mm / geometry_mm; }
};

Pair BothOf(v1::CalibrationInput input, const std::string& split) {
  input.mutable_options()->set_split(split);
  const double geometry_mm = testing::ControlRms(testing::MustCalibrate(input));
  input.mutable_options()->set_effects("auto");
  const v1::Calibration calibration = testing::MustCalibrate(input);
  return {geometry_mm, testing::ControlRms(calibration), calibration.report().effects_size()};
}

// 20 halves measured a median of 0.357 mm, 0.374 mm at most, and at most 0.891 of the geometry's.
// Would catch effects that are not found, not fitted or not carried to the control set.
TEST(MeasuredEffects, Ur10SeriesDRandomHalves) {
  std::vector<double> effects_mm;
  double largest_ratio = 0;
  for (int seed = 1; seed <= testing::Draws(3, 20); ++seed) {
    const Pair pair = BothOf(testing::Ur10Series("D"), testing::RandomSplit(seed, 316, 632));
    EXPECT_LE(pair.effects_mm, 0.38) << "seed " << seed;
    EXPECT_LE(pair.Ratio(), 0.91) << "seed " << seed;
    effects_mm.push_back(pair.effects_mm);
    largest_ratio = std::max(largest_ratio, pair.Ratio());
  }
  const double median_mm = testing::MedianOf(effects_mm);
  std::cout << "median " << median_mm << " mm, largest "
            << *std::max_element(effects_mm.begin(), effects_mm.end()) << " mm, largest ratio "
            << largest_ratio << "\n";
  EXPECT_LE(median_mm, 0.365);
}

struct FewRows {
  int rows, few, many;
};

class EffectsOfFewRows : public ::testing::TestWithParam<FewRows> {};

// The trap: from 50 rows BIC and cross-validation both take terms that hurt (0.551 -> 0.564 mm).
// 40 draws of 50 rows and 20 of 200 and 400 measured 1.000, 1.000 and 0.996 at most. 1 %: a term
// that helps the calibration rows by chance costs less than that when the choice is sound.
TEST_P(EffectsOfFewRows, NeverHurt) {
  double largest = 0;
  for (int seed = 1; seed <= testing::Draws(GetParam().few, GetParam().many); ++seed) {
    const Pair pair =
        BothOf(testing::Ur10Series("C"), testing::RandomSplit(seed, GetParam().rows, 2773));
    EXPECT_LE(pair.Ratio(), 1.01) << "seed " << seed;
    // Fewer than nine values a parameter of the geometry and the smallest group entitle to none.
    if (GetParam().rows * 6 < 9 * 36) {
      EXPECT_EQ(pair.groups, 0) << "seed " << seed;
    }
    largest = std::max(largest, pair.Ratio());
  }
  std::cout << GetParam().rows << " rows: largest ratio " << largest << "\n";
}

INSTANTIATE_TEST_SUITE_P(Ur10SeriesC, EffectsOfFewRows,
                         ::testing::Values(FewRows{50, 5, 40}, FewRows{200, 2, 20},
                                           FewRows{400, 2, 20}),
                         [](const auto& info) { return "Rows" + std::to_string(info.param.rows); });

}  // namespace
}  // namespace truepose
