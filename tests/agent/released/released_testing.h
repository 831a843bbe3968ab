// A server's jobs that build test tables.
#pragma once

#include <array>

#include "server/jobs/runner.h"
#include "tests/agent/released/test_table.h"

namespace truepose::agent::testing {

// Builds them as a job does, whatever the calibration holds, with `nodes` of each unfolded axis.
jobs::TableBuilder TestTableBuilder(const std::array<int, 4>& nodes = {2, 3, 2, 3});

}  // namespace truepose::agent::testing
