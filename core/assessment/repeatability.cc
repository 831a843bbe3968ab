#include "core/assessment/repeatability.h"

#include <cmath>

namespace truepose {
namespace {

std::vector<double> DistancesToBarycentre(const Eigen::Matrix3Xd& points) {
  const Eigen::RowVectorXd l = (points.colwise() - points.rowwise().mean()).colwise().norm();
  return {l.data(), l.data() + l.size()};
}

// l-bar + 3 S_l.
double Rp(const std::vector<double>& l) {
  const Statistics s = StatisticsOf(l);
  const double n = static_cast<double>(l.size());
  return s.mean + 3 * s.sd * std::sqrt(n / (n - 1));
}

}  // namespace

PairRepeatability RepeatabilityOfPairs(
    const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>& pairs) {
  std::vector<double> distances;
  for (const auto& [a, b] : pairs) distances.push_back((a - b).norm());
  const Statistics s = StatisticsOf(distances);
  return {s, s.mean + 3 * s.sd};
}

IsoRepeatability RepeatabilityOfGroups(const std::vector<Eigen::Matrix3Xd>& groups) {
  IsoRepeatability result;
  std::vector<double> all;
  for (const Eigen::Matrix3Xd& points : groups) {
    if (points.cols() < 2) continue;
    const std::vector<double> l = DistancesToBarycentre(points);
    all.insert(all.end(), l.begin(), l.end());
    ++result.groups;
  }
  result.points = static_cast<int>(all.size());
  if (!all.empty()) result.pooled_m = Rp(all);
  return result;
}

}  // namespace truepose
