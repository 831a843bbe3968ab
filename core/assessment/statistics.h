// Sizes of pose errors over a set of readings.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/identification/problem.h"

namespace truepose {

// Of a set of non-negative sizes. sd is that of the population, so rms^2 = mean^2 + sd^2. All zero
// for an empty set.
struct Statistics {
  double mean = 0, sd = 0, rms = 0, max = 0;
};

Statistics StatisticsOf(const std::vector<double>& sizes);

// One reading: |position residual| in m; angle of the rotation residual in rad, negative when none
// was measured.
struct PoseError {
  int id = 0;
  double position_m = 0;
  double rotation_rad = -1;
  int row = -1;  // Reading::row
};

struct PoseStatistics {
  int poses = 0;  // units: several points of one row are one
  Statistics position_m;
  Statistics rotation_rad;
  bool has_rotation = false;
};

// Which errors are of one row (reading.h).
Units UnitsOf(const std::vector<PoseError>& errors);

std::vector<PoseError> PoseErrors(const Problem& problem, const Estimate& estimate);
PoseStatistics PoseStatisticsOf(const std::vector<PoseError>& errors);

}  // namespace truepose
