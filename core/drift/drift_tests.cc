#include "core/drift/drift_tests.h"

#include <algorithm>
#include <cmath>

#include "core/base/chi_square.h"
#include "core/base/f_distribution.h"

namespace truepose {

double DropProbability(const DriftSums& sums, double drop, int freedom) {
  if (freedom == 0) return 1;
  const double scaled = drop / sums.Scale();
  if (sums.redundancy == 0) return ChiSquareSurvival(scaled, freedom);
  return FSurvival(scaled / freedom, freedom, sums.redundancy);
}

double RestProbability(const DriftSums& sums) {
  const double m = sums.rest_freedom;
  const Eigen::VectorXd& of = sums.rest_of_readings;
  const double seen = (of.array() - of.mean()).square().sum() / (m * m);
  double variance = std::max(2 / m, seen);
  if (sums.redundancy > 0) variance += 2.0 / sums.redundancy;
  const int freedom = std::max(1, static_cast<int>(std::lround(2 / variance)));
  return ChiSquareSurvival(sums.rest / m * freedom, freedom);
}

double ChangeProbability(const DriftSums& sums) {
  const double of_drop = DropProbability(sums, sums.drop, sums.drop_freedom);
  return std::min(1.0, 2 * std::min(of_drop, RestProbability(sums)));
}

Eigen::VectorXd SumsOfReadings(const Problem& problem, const Eigen::VectorXd& r) {
  Eigen::VectorXd sums(static_cast<Eigen::Index>(problem.readings.size()));
  Eigen::Index row = 0;
  for (Eigen::Index h = 0; h < sums.size(); ++h) {
    const int n = RowsOf(problem.readings[static_cast<size_t>(h)]);
    sums(h) = r.segment(row, n).squaredNorm();
    row += n;
  }
  return sums;
}

}  // namespace truepose
