#include <Eigen/Dense>
#include <limits>

#include "compensation/lookup.h"

namespace truepose::compensation {
namespace {

// An axis of more than one node. A folded one has no range of nodes to leave.
void AddUnfolded(const TableAxis& axis, int index, Grid* grid) {
  const int k = grid->unfolded++;
  grid->axis[k] = index;
  grid->inverse_step[k] = (axis.nodes - 1) / (axis.upper - axis.lower + 2 * axis.margin);
  grid->last_cell[k] = axis.nodes - 2;
}

void SetRange(const TableAxis& axis, int index, Grid* grid) {
  const double infinity = std::numeric_limits<double>::infinity();
  grid->lower[index] = axis.lower;
  grid->upper[index] = axis.upper;
  grid->grid_lower[index] = axis.nodes > 1 ? axis.lower - axis.margin : -infinity;
  grid->grid_upper[index] = axis.nodes > 1 ? axis.upper + axis.margin : infinity;
}

// The last unfolded axis' neighbours are adjacent.
void SetStrides(const std::array<TableAxis, kMaxJoints>& axis, Grid* grid) {
  std::ptrdiff_t stride = kNodeFloats;
  for (int k = grid->unfolded - 1; k >= 0; --k) {
    grid->stride[k] = stride;
    stride *= axis[grid->axis[k]].nodes;
  }
}

void ListCorners(Grid* grid) {
  if (grid->unfolded > Grid::kFastAxes) return;
  for (int k = 0; k + 1 < grid->unfolded; ++k) {
    for (int corner = 0; corner < 1 << k; ++corner)
      grid->corner[corner + (1 << k)] = grid->corner[corner] + grid->stride[k];
  }
}

void InvertJointMap(Table* table) {
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxJoints,
                               kMaxJoints>;
  const int n = table->header.joints;
  const Square scale = table->arm.joint_scale.topLeftCorner(n, n);
  table->controller_from_chain.setIdentity();
  table->controller_from_chain.topLeftCorner(n, n) = scale.partialPivLu().inverse();
  table->plain_joints =
      scale == Square::Identity(n, n) && table->arm.joint_offset.head(n).isZero(0);
}

}  // namespace

Table MakeTable(const TableHeader& header, const Arm& arm,
                const std::array<TableAxis, kMaxJoints>& axis,
                std::span<const float> nodes) noexcept {
  Table table;
  table.header = header;
  table.arm = arm;
  table.axis = axis;
  table.nodes = nodes;
  for (int i = 0; i < header.joints; ++i) {
    for (int j = 0; j < header.joints; ++j) table.grid.weight[j][i] = axis[i].weight[j];
    SetRange(axis[i], i, &table.grid);
    if (axis[i].nodes > 1) AddUnfolded(axis[i], i, &table.grid);
  }
  SetStrides(axis, &table.grid);
  ListCorners(&table.grid);
  InvertJointMap(&table);
  return table;
}

Table MakeTable(const TableContent& content) noexcept {
  return MakeTable(content.header, content.arm, content.axis, content.nodes);
}

}  // namespace truepose::compensation
