#include "core/reproduce/printed.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/reproduce/measuring_robot.h"

namespace truepose {
namespace {

// The complete set pools the calibration set and the control set, so its mean follows from theirs:
// each figure is checked by two others, to a unit of the last digit of each. Would catch a figure
// copied wrongly.
TEST(Printed, MeansOfTheCompleteSetPoolTheOthers) {
  for (const PrintedRow& row : PrintedRows()) {
    if (!row.control) {
      EXPECT_EQ(row.complete.mean_mm, row.calibration.mean_mm);
      continue;
    }
    const double n = row.calibration_poses;
    const double pooled = (n * row.calibration.mean_mm + (81 - n) * row.control->mean_mm) / 81;
    EXPECT_NEAR(row.complete.mean_mm, pooled, 1.1e-3) << row.table << row.algorithm << n;
  }
}

// As chapter-notes say: in four rows the maxima do not pool. Would catch a wrong maximum, and a
// chapter silently corrected.
TEST(Printed, MaximaPoolButForFourRows) {
  std::vector<std::string> apart;
  for (const PrintedRow& row : PrintedRows()) {
    const double most = std::max(row.calibration.max_mm, row.control ? row.control->max_mm : 0);
    // 1.462 and 1.463 is one of the four.
    if (std::abs(most - row.complete.max_mm) > 1e-9)
      apart.push_back(std::to_string(row.table) + row.algorithm +
                      std::to_string(row.calibration_poses));
  }
  EXPECT_EQ(apart, (std::vector<std::string>{"5amoeba40", "5amoeba60", "6linear40", "6linear60"}));
}

// The chapter's sentence after Table 7: two parameters were selected most often, five times and
// four times or more of nine. Would catch a row of Table 8 shifted by a column.
TEST(Printed, A3AndAl3AreSelectedMostOften) {
  std::vector<int> times;
  for (const std::string& name : AdditionalSet()) {
    times.push_back(0);
    for (const PrintedSelection& selection : PrintedSelections())
      times.back() +=
          static_cast<int>(std::count(selection.added.begin(), selection.added.end(), name));
  }
  EXPECT_EQ(PrintedSelections().size(), 9u);
  //                                     a1 al1 al2 y2 d3 a3 al3 a4 al4 a5 al5
  EXPECT_EQ(times, (std::vector<int>{3, 0, 1, 1, 4, 4, 5, 3, 1, 1, 2}));
}

TEST(Printed, RepeatabilityIsMeanPlusThreeDeviations) {
  const PrintedRepeatability r;
  EXPECT_NEAR(r.mean_mm + 3 * r.sd_mm, r.mean_plus_3_sd_mm, 1e-12);
}

}  // namespace
}  // namespace truepose
