// Contact readings against each other: how well one ball in one socket is predicted to be one
// point, without any absolute measurement.
#pragma once

#include <vector>

#include "core/assessment/statistics.h"

namespace truepose {

struct PlaceErrors {
  // Distance of each contact reading's predicted point X_BT from the mean of its place's own
  // readings, m. A place is one measured point of one placement; those with one reading are left
  // out.
  std::vector<PoseError> errors;
  // Largest |distance between the means of two places - their distance in the fixture| over the
  // pairs of a placement, m; 0 when there is no pair.
  double largest_spacing_error_m = 0;
};

// @param problem readings that are not contacts are ignored; base frames take no part.
PlaceErrors PlaceErrorsOf(const Problem& problem, const Estimate& estimate);

}  // namespace truepose
