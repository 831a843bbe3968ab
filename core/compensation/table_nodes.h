// The nodes of a table's grid: their places, and what stands in them.
#pragma once

#include <array>
#include <cstdint>

#include "absl/status/status.h"
#include "compensation/table.h"
#include "core/base/hooks.h"
#include "core/compensation/table_axes.h"

namespace truepose {

// Nodes of all coordinates, the last one fastest.
class NodeGrid {
 public:
  NodeGrid(const std::array<compensation::TableAxis, compensation::kMaxJoints>& axis, int joints);

  int64_t size() const { return size_; }
  int joints() const { return joints_; }
  // Numbers along each coordinate of a node, and back.
  using Place = std::array<int, compensation::kMaxJoints>;
  Place PlaceOf(int64_t node) const;
  int64_t NodeAt(const Place& place) const;
  int nodes(int k) const { return axis_[static_cast<size_t>(k)].nodes; }
  // u_k `along` steps from the first node; of a folded coordinate the middle of its range.
  double ValueAt(int k, double along) const;

 private:
  const std::array<compensation::TableAxis, compensation::kMaxJoints>& axis_;
  int joints_;
  int64_t size_ = 1;
};

// Computes every node of content->arm at the nodes of content->axis.
// @param hooks progress "nodes" from `begin` to `end`. @returns kCancelled.
absl::Status FillNodes(const TableAxes& axes, const Hooks& hooks, double begin, double end,
                       compensation::TableContent* content);

}  // namespace truepose
