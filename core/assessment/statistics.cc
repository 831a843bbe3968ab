#include "core/assessment/statistics.h"

#include <algorithm>
#include <cmath>

#include "core/identification/prediction.h"

namespace truepose {

Statistics StatisticsOf(const std::vector<double>& sizes) {
  Statistics result;
  if (sizes.empty()) return result;
  const double n = static_cast<double>(sizes.size());
  double sum = 0, squares = 0, deviations = 0;
  for (double size : sizes) {
    sum += size;
    squares += size * size;
    result.max = std::max(result.max, size);
  }
  result.mean = sum / n;
  for (double size : sizes) deviations += (size - result.mean) * (size - result.mean);
  result.sd = std::sqrt(deviations / n);
  result.rms = std::sqrt(squares / n);
  return result;
}

Units UnitsOf(const std::vector<PoseError>& errors) {
  std::vector<int> rows;
  for (const PoseError& error : errors) rows.push_back(error.row);
  return UnitsOfRows(rows);
}

std::vector<PoseError> PoseErrors(const Problem& problem, const Estimate& estimate) {
  std::vector<PoseError> errors;
  for (const Reading& reading : problem.readings) {
    const Residual r = ResidualAt(problem, reading, estimate);
    const Eigen::Index rotations = RotationRowsOf(reading);
    errors.push_back({reading.id, r.head(r.size() - rotations).norm(),
                      rotations > 0 ? r.tail(rotations).norm() : -1.0, reading.row});
  }
  return errors;
}

PoseStatistics PoseStatisticsOf(const std::vector<PoseError>& errors) {
  std::vector<double> positions, rotations;
  for (const PoseError& error : errors) {
    positions.push_back(error.position_m);
    if (error.rotation_rad >= 0) rotations.push_back(error.rotation_rad);
  }
  return {UnitsOf(errors).count, StatisticsOf(positions), StatisticsOf(rotations),
          !rotations.empty()};
}

}  // namespace truepose
