// Lookup of a table's correction, and what it takes to be fast: about 0.1 us.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>

#include "compensation/table.h"

namespace truepose::compensation {

using Delta = Eigen::Matrix<double, 6, 1>;  // (t, r), see table.h

// What the axes come to, for each joint and unfolded axis; MakeTable fills it.
struct Grid {
  static constexpr int kFastAxes = 6;  // with so many unfolded axes or fewer corners are listed

  // Coordinates of all axes by chain joint: u[axis] = sum_j weight[j][axis] q_chain[j].
  std::array<std::array<double, kMaxJoints>, kMaxJoints> weight{};
  std::array<double, kMaxJoints> lower{}, upper{};            // the domain
  std::array<double, kMaxJoints> grid_lower{}, grid_upper{};  // the domain and its margin
  int unfolded = 0;
  // Of the k-th unfolded axis: which it is, nodes per unit of u, index of the last cell, and floats
  // from a node to the next.
  std::array<int, kMaxJoints> axis{};
  std::array<double, kMaxJoints> inverse_step{};
  std::array<int, kMaxJoints> last_cell{};
  std::array<std::ptrdiff_t, kMaxJoints> stride{};
  // Floats from a cell's lowest corner to those of all unfolded axes but the last; bit k of the
  // index is the k-th unfolded axis.
  std::array<std::ptrdiff_t, std::size_t{1} << (kFastAxes - 1)> corner{};
};

// A table whose fields were checked, ready for lookups. A plain value but for the nodes, which must
// live as long; nothing in it changes, so any number of threads may read it.
struct Table {
  TableHeader header;
  Arm arm;
  std::array<TableAxis, kMaxJoints> axis;
  std::span<const float> nodes;
  Grid grid;
  bool plain_joints = true;  // the controller's joints are the chain's
  Eigen::Matrix<double, kMaxJoints, kMaxJoints> controller_from_chain;  // inverse of joint_scale
};

// @pre CheckTable accepts the fields.
Table MakeTable(const TableHeader& header, const Arm& arm,
                const std::array<TableAxis, kMaxJoints>& axis,
                std::span<const float> nodes) noexcept;
// @param content  Check(content).ok(); must outlive the table
Table MakeTable(const TableContent& content) noexcept;

// Where a lookup is allowed: targets in the domain, corrected joints also in its margin.
enum class Reach { kDomain, kGrid };

enum class LookupFault { kNone, kOutside, kNotFinite };

struct Lookup {
  LookupFault fault = LookupFault::kNone;
  int axis = -1;                // of kOutside: the first that is left
  Delta delta = Delta::Zero();  // zero unless kNone
};

// Multilinear interpolation of the nodes around q_chain, never extrapolation.
// @param q_chain  joints of the nominal chain, header.joints numbers
Lookup LookUp(const Table& table, const double* q_chain, Reach reach) noexcept;

// Coordinates of all axes at q_chain.
std::array<double, kMaxJoints> CoordinatesOf(const Table& table, const double* q_chain) noexcept;

}  // namespace truepose::compensation
