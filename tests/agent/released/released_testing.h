// Tables of robots/arm as a server would release them.
#pragma once

#include <array>
#include <string>

#include "client/agent/released/released_entry.h"
#include "compensation/table.h"
#include "server/jobs/runner.h"

namespace truepose::agent::testing {

// A small table by the calibration of this number; each number has other parameters.
struct TestTable {
  explicit TestTable(int calibration, const std::string& robot = "robots/arm");

  compensation::TableContent content;
  std::string bytes;    // of its file
  ReleasedEntry entry;  // made active in the order of the numbers
};

// Builds them as a job does, whatever the calibration holds, with `nodes` of each unfolded axis.
jobs::TableBuilder TestTableBuilder(const std::array<int, 4>& nodes = {2, 3, 2, 3});

}  // namespace truepose::agent::testing
