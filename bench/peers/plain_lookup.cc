#include "bench/peers/plain_lookup.h"

#include <cmath>
#include <stdexcept>
#include <vector>

namespace truepose::bench {
namespace {

struct Place {
  int index;
  double along;
};

Place PlaceOn(const compensation::TableAxis& axis, int joints, const double* q) {
  double u = 0;
  for (int j = 0; j < joints; ++j) u += axis.weight[j] * q[j];
  if (!(u >= axis.lower && u <= axis.upper)) throw std::out_of_range("outside of the table");
  if (axis.nodes == 1) return {0, 0};
  const double first = axis.lower - axis.margin, last = axis.upper + axis.margin;
  const double steps = (u - first) * (axis.nodes - 1) / (last - first);
  const int index = std::min(static_cast<int>(std::floor(steps)), axis.nodes - 2);
  return {index, steps - index};
}

}  // namespace

Eigen::Matrix<double, 6, 1> PlainLookUp(const compensation::TableContent& table, const double* q) {
  const int n = table.header.joints;
  std::vector<Place> places;
  for (int i = 0; i < n; ++i) places.push_back(PlaceOn(table.axis[i], n, q));
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (int corner = 0; corner < 1 << n; ++corner) {
    double weight = 1;
    size_t node = 0;
    for (int i = 0; i < n; ++i) {
      const int upper = corner >> i & 1;
      weight *= upper ? places[i].along : 1 - places[i].along;
      node = node * table.axis[i].nodes + places[i].index + (table.axis[i].nodes > 1 ? upper : 0);
    }
    if (weight == 0) continue;
    sum += weight *
           Eigen::Map<const Eigen::Matrix<float, 6, 1>>(&table.nodes[6 * node]).cast<double>();
  }
  return sum;
}

}  // namespace truepose::bench
