#include "core/compensation/worst_nodes.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

#include "core/compensation/table_grid.h"
#include "core/compensation/table_nodes.h"

namespace truepose {
namespace {

using compensation::kNodeFloats;
using compensation::Table;

using Ranked = std::pair<double, int64_t>;  // (sum of second differences, node)
// The smallest on top, to make room for a larger one.
using Smallest = std::priority_queue<Ranked, std::vector<Ranked>, std::greater<>>;

Twist NodeOf(const Table& table, int64_t node) {
  return Eigen::Map<const Eigen::Matrix<float, 6, 1>>(table.nodes.data() + node * kNodeFloats)
      .cast<double>();
}

class SecondDifferences {
 public:
  explicit SecondDifferences(const Table& table)
      : table_(table),
        grid_(table.axis, table.header.joints),
        units_{table.header.tolerance.position_m, table.header.tolerance.rotation_rad},
        p_LF_(FlangeInL(table.arm, 0)) {}

  int64_t size() const { return grid_.size(); }

  double SumAt(int64_t node) const {
    const NodeGrid::Place place = grid_.PlaceOf(node);
    double sum = 0;
    int64_t stride = 1;
    for (int k = grid_.joints() - 1; k >= 0; stride *= grid_.nodes(k--)) {
      const int at = place[static_cast<size_t>(k)];
      if (at == 0 || at + 1 >= grid_.nodes(k)) continue;
      const Twist difference =
          NodeOf(table_, node - stride) - 2 * NodeOf(table_, node) + NodeOf(table_, node + stride);
      sum += units_.SizeOf(FlangeMotion(difference, p_LF_));
    }
    return sum;
  }

 private:
  const Table& table_;
  NodeGrid grid_;
  ToleranceUnits units_;
  Eigen::Vector3d p_LF_;
};

}  // namespace

std::vector<int64_t> WorstNodes(const Table& table, size_t count) {
  const SecondDifferences differences(table);
  Smallest worst;
  for (int64_t node = 0; node < differences.size(); ++node) {
    const double sum = differences.SumAt(node);
    if (worst.size() == count && sum <= worst.top().first) continue;
    if (worst.size() == count) worst.pop();
    worst.push({sum, node});
  }
  std::vector<int64_t> nodes(worst.size());
  for (auto node = nodes.rbegin(); node != nodes.rend(); ++node, worst.pop())
    *node = worst.top().second;
  return nodes;
}

}  // namespace truepose
