// How closely a robot, or a person with a measuring robot, comes back to the same place.
//
// Two figures that are not each other (chapter-notes 27):
//   of pairs     d-bar + 3 sigma of the distance between two readings of the same place; the
//                chapter's 0.268 mm (Sec. 11.3), which calls it ISO 9283 but is not
//   ISO 9283 RP  l-bar + 3 S_l, l the distance of an attained point to the barycentre of the n
//                points attained at its place, S_l with n - 1
// Two readings lie d/2 from their barycentre, so RP of pairs, pooled, is half the first figure.
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

#include "core/assessment/statistics.h"

namespace truepose {

struct PairRepeatability {
  Statistics difference_m;  // sd that of the population, as all of Statistics
  double mean_plus_3_sd_m = 0;
};

// @param pairs the same place read twice. All zero for none.
PairRepeatability RepeatabilityOfPairs(
    const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& pairs);

struct IsoRepeatability {
  int groups = 0;  // with at least two points; others tell nothing
  int points = 0;  // in these
  // RP of the distances of all groups together, S_l with points - 1. The figure to quote: it exists
  // from two readings a place on, and many places make up for few readings.
  double pooled_m = 0;
};

// @param groups points attained at each place, as columns.
IsoRepeatability RepeatabilityOfGroups(const std::vector<Eigen::Matrix3Xd>& groups);

}  // namespace truepose
