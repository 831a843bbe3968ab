// Where a grid of nodes interpolates worst.
#pragma once

#include <cstdint>
#include <vector>

#include "compensation/lookup.h"

namespace truepose {

// At most `count` nodes with the largest sums of second differences along the coordinates, in units
// of the table's tolerances, the largest first.
std::vector<int64_t> WorstNodes(const compensation::Table& table, size_t count);

}  // namespace truepose
