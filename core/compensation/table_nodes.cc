#include "core/compensation/table_nodes.h"

#include "core/compensation/correction_twist.h"

namespace truepose {
namespace {

using compensation::kNodeFloats;
using compensation::TableContent;

constexpr int64_t kBetweenReports = 4096;  // some milliseconds

void FillNode(const TableAxes& axes, const NodeGrid& grid, int64_t node, TableContent* content) {
  const NodeGrid::Place place = grid.PlaceOf(node);
  JointVector u(grid.joints());
  for (int k = 0; k < grid.joints(); ++k) u(k) = grid.ValueAt(k, place[static_cast<size_t>(k)]);
  const JointVector q = axes.ToController(u);
  const Twist twist = CorrectionTwist(content->arm, q.data());
  for (int i = 0; i < kNodeFloats; ++i)
    content->nodes[static_cast<size_t>(node * kNodeFloats + i)] = static_cast<float>(twist(i));
}

}  // namespace

NodeGrid::NodeGrid(const std::array<compensation::TableAxis, compensation::kMaxJoints>& axis,
                   int joints)
    : axis_(axis), joints_(joints) {
  for (int k = 0; k < joints; ++k) size_ *= nodes(k);
}

NodeGrid::Place NodeGrid::PlaceOf(int64_t node) const {
  Place place{};
  for (int k = joints_ - 1; k >= 0; --k) {
    place[static_cast<size_t>(k)] = static_cast<int>(node % nodes(k));
    node /= nodes(k);
  }
  return place;
}

int64_t NodeGrid::NodeAt(const Place& place) const {
  int64_t node = 0;
  for (int k = 0; k < joints_; ++k) node = node * nodes(k) + place[static_cast<size_t>(k)];
  return node;
}

double NodeGrid::ValueAt(int k, double along) const {
  const compensation::TableAxis& axis = axis_[static_cast<size_t>(k)];
  if (axis.nodes == 1) return (axis.lower + axis.upper) / 2;
  const double step = (axis.upper - axis.lower + 2 * axis.margin) / (axis.nodes - 1);
  return axis.lower - axis.margin + along * step;
}

absl::Status FillNodes(const TableAxes& axes, const Hooks& hooks, double begin, double end,
                       TableContent* content) {
  const NodeGrid grid(content->axis, content->header.joints);
  content->nodes.resize(static_cast<size_t>(grid.size() * kNodeFloats));
  for (int64_t node = 0; node < grid.size(); ++node) {
    if (node % kBetweenReports == 0) {
      if (hooks.Cancelled()) return absl::CancelledError("cancelled while filling the table");
      const double share = static_cast<double>(node) / static_cast<double>(grid.size());
      hooks.Report({"nodes", begin + (end - begin) * share});
    }
    FillNode(axes, grid, node, content);
  }
  return absl::OkStatus();
}

}  // namespace truepose
