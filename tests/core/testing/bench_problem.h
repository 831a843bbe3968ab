// The simulated problems of the shared bench folder: readings, nominal robot, and the true robot.
#pragma once

#include <string>
#include <vector>

#include "core/chain/chain.h"
#include "core/measurement/reading.h"
#include "core/robot/robot.h"
#include "tests/core/testing/table.h"

namespace truepose::testing {

struct BenchProblem {
  Robot robot;  // nominal, without base and tool
  std::vector<Reading> readings;
  Chain truth;  // from instrument to target, at the true parameters
  int joints;
};

// @param name "arm5" or "arm6"; @param poses 81 or 1000.
BenchProblem LoadBench(const std::string& name, int poses, ObservationKind kind);

}  // namespace truepose::testing
