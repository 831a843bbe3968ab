// Whether the fields of a table can be right, so that what uses them need not ask again: counts
// within their arrays, numbers finite, rotations rotations, joint map and axes invertible.
#pragma once

#include <array>
#include <span>

#include "compensation/table.h"
#include "compensation/table_report.h"

namespace truepose::compensation {

// @param axes  of which the first header.joints count
// @param nodes  all floats of the grid
// @returns kInvalidField with the first field that cannot be, what was found and what was expected.
TableReport CheckTable(const TableHeader& header, const Arm& arm,
                       const std::array<TableAxis, kMaxJoints>& axes,
                       std::span<const float> nodes) noexcept;

// The floats that the axes ask for; 0 when there is an axis of no nodes or they are more than 2^40.
std::size_t FloatsOfGrid(const std::array<TableAxis, kMaxJoints>& axes, int joints) noexcept;

}  // namespace truepose::compensation
