#include "core/assessment/repeatability.h"

#include <gtest/gtest.h>

namespace truepose {
namespace {

using Pairs = std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>;

// 80 pairs whose distances have the chapter's mean 0.082 and sd 0.062 mm exactly, in directions
// that do not matter.
Pairs ChapterPairs() {
  Pairs pairs;
  for (int i = 0; i < 80; ++i) {
    const Eigen::Vector3d place(0.1 * i, -0.3, 0.2);
    const Eigen::Vector3d direction = Eigen::Vector3d(1, i % 3, -2).normalized();
    pairs.emplace_back(place, place + (i % 2 == 0 ? 0.144e-3 : 0.020e-3) * direction);
  }
  return pairs;
}

std::vector<Eigen::Matrix3Xd> AsGroups(const Pairs& pairs) {
  std::vector<Eigen::Matrix3Xd> groups;
  for (const auto& [a, b] : pairs) groups.emplace_back(3, 2) << a, b;
  return groups;
}

// Would catch the factor on sigma, or a sd of n - 1 under the chapter's name.
TEST(Repeatability, OfPairsIsTheChaptersFigure) {
  const PairRepeatability r = RepeatabilityOfPairs(ChapterPairs());
  EXPECT_NEAR(r.difference_m.mean, 0.082e-3, 1e-12);
  EXPECT_NEAR(r.difference_m.sd, 0.062e-3, 1e-12);
  EXPECT_NEAR(r.mean_plus_3_sd_m, 0.268e-3, 1e-12);
}

// Would catch distances between readings in place of distances to their barycentre, and RP by pair,
// whose S_l is 0: that gives 0.041 mm. (0.1343: S_l with n - 1 of 160 is 0.3 % above sigma.)
TEST(Repeatability, IsoOfTwoReadingsEachIsHalfOfThat) {
  const IsoRepeatability r = RepeatabilityOfGroups(AsGroups(ChapterPairs()));
  EXPECT_EQ(r.groups, 80);
  EXPECT_EQ(r.points, 160);
  EXPECT_NEAR(r.pooled_m, 0.134e-3, 0.0005e-3);
}

// By hand: barycentre (1, 1, 0), l = sqrt 2, sqrt 5, sqrt 5, S_l = 0.47450 with n - 1.
TEST(Repeatability, IsoOfThreePointsByHand) {
  Eigen::Matrix3Xd points(3, 3);
  points << 0, 3, 0,  //
      0, 0, 3,        //
      0, 0, 0;
  const IsoRepeatability r = RepeatabilityOfGroups({points});
  EXPECT_NEAR(r.pooled_m, 3.38562, 1e-5);
}

// Would catch groups of one point that count.
TEST(Repeatability, SinglePointsTellNothing) {
  Eigen::Matrix3Xd wide(3, 3), tight(3, 3), single(3, 1);
  wide << 0, 3, 0, 0, 0, 3, 0, 0, 0;
  tight = 0.1 * wide;
  single << 1, 2, 3;
  const IsoRepeatability r = RepeatabilityOfGroups({tight, wide, tight, single});
  EXPECT_EQ(r.groups, 3);
  EXPECT_EQ(r.points, 9);
}

TEST(Repeatability, OfNothingIsZero) {
  EXPECT_EQ(RepeatabilityOfPairs({}).mean_plus_3_sd_m, 0);
  EXPECT_EQ(RepeatabilityOfGroups({}).pooled_m, 0);
}

}  // namespace
}  // namespace truepose
