#include "compensation/lookup.h"

#include <algorithm>

#include "compensation/valid.h"

namespace truepose::compensation {
namespace {

using Four = Eigen::Array4f;

// The cell around a point: its lowest corner, and how far along each unfolded axis, 0 to 1.
struct Cell {
  const float* lowest;
  std::array<float, kMaxJoints> along;
};

Cell CellAt(const Table& table, const double* u) {
  const Grid& grid = table.grid;
  Cell cell;
  std::ptrdiff_t offset = 0;
  for (int k = 0; k < grid.unfolded; ++k) {
    const int axis = grid.axis[k];
    const double steps = (u[axis] - grid.grid_lower[axis]) * grid.inverse_step[k];
    const int index = std::min(static_cast<int>(steps), grid.last_cell[k]);
    cell.along[k] = static_cast<float>(steps - index);
    offset += index * grid.stride[k];
  }
  cell.lowest = table.nodes.data() + offset;
  return cell;
}

// Weighted corners of all axes but the last: two neighbours of the last axis, 12 floats.
struct Pair {
  Four a = Four::Zero(), b = Four::Zero(), c = Four::Zero();

  void Add(float weight, const float* at) {
    a += weight * Eigen::Map<const Four>(at);
    b += weight * Eigen::Map<const Four>(at + 4);
    c += weight * Eigen::Map<const Four>(at + 8);
  }
  Delta At(float along) const {
    Eigen::Array<float, 12, 1> nodes;
    nodes << a, b, c;
    return (nodes.head<6>() + along * (nodes.tail<6>() - nodes.head<6>())).matrix().cast<double>();
  }
};

// The sum over 2^axes corners, in the order of Grid::corner.
template <int axes>
Delta Interpolate(const Grid& grid, const Cell& cell) {
  constexpr int kCorners = 1 << (axes - 1);
  std::array<float, kCorners> weight;
  weight[0] = 1;
  for (int k = 0; k + 1 < axes; ++k) {
    for (int corner = 0; corner < 1 << k; ++corner) {
      weight[corner + (1 << k)] = weight[corner] * cell.along[k];
      weight[corner] -= weight[corner + (1 << k)];
    }
  }
  Pair pair;
  for (int corner = 0; corner < kCorners; ++corner)
    pair.Add(weight[corner], cell.lowest + grid.corner[corner]);
  return pair.At(cell.along[axes - 1]);
}

// For more unfolded axes than corners are listed for.
Delta InterpolateMany(const Grid& grid, const Cell& cell) {
  Pair pair;
  for (int corner = 0; corner < 1 << (grid.unfolded - 1); ++corner) {
    float weight = 1;
    std::ptrdiff_t offset = 0;
    for (int k = 0; k + 1 < grid.unfolded; ++k) {
      const bool upper = corner >> k & 1;
      weight *= upper ? cell.along[k] : 1 - cell.along[k];
      offset += upper ? grid.stride[k] : 0;
    }
    pair.Add(weight, cell.lowest + offset);
  }
  return pair.At(cell.along[grid.unfolded - 1]);
}

Delta InterpolateAt(const Table& table, const double* u) {
  const Cell cell = CellAt(table, u);
  switch (table.grid.unfolded) {
    case 0:
      return Eigen::Map<const Eigen::Matrix<float, 6, 1>>(table.nodes.data()).cast<double>();
    case 1:
      return Interpolate<1>(table.grid, cell);
    case 2:
      return Interpolate<2>(table.grid, cell);
    case 3:
      return Interpolate<3>(table.grid, cell);
    case 4:
      return Interpolate<4>(table.grid, cell);
    case 5:
      return Interpolate<5>(table.grid, cell);
    case 6:
      return Interpolate<6>(table.grid, cell);
    default:
      return InterpolateMany(table.grid, cell);
  }
}

// The first axis that is left, also by what is no number; -1 inside.
int OutsideAxis(const Table& table, const double* u, Reach reach) {
  const Grid& grid = table.grid;
  const double* lower = reach == Reach::kDomain ? grid.lower.data() : grid.grid_lower.data();
  const double* upper = reach == Reach::kDomain ? grid.upper.data() : grid.grid_upper.data();
  for (int i = 0; i < table.header.joints; ++i) {
    if (!(u[i] >= lower[i] && u[i] <= upper[i])) return i;
  }
  return -1;
}

}  // namespace

std::array<double, kMaxJoints> CoordinatesOf(const Table& table, const double* q_chain) noexcept {
  std::array<double, kMaxJoints> u{};
  for (int j = 0; j < table.header.joints; ++j) {
    for (int i = 0; i < kMaxJoints; ++i) u[i] += table.grid.weight[j][i] * q_chain[j];
  }
  return u;
}

Lookup LookUp(const Table& table, const double* q_chain, Reach reach) noexcept {
  const std::array<double, kMaxJoints> u = CoordinatesOf(table, q_chain);
  Lookup lookup;
  const int outside = OutsideAxis(table, u.data(), reach);
  if (outside >= 0) {
    const bool finite = AreFinite(q_chain, table.header.joints);
    lookup.fault = finite ? LookupFault::kOutside : LookupFault::kNotFinite;
    lookup.axis = finite ? outside : -1;
    return lookup;
  }
  lookup.delta = InterpolateAt(table, u.data());
  return lookup;
}

}  // namespace truepose::compensation
