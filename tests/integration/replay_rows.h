// One row an RPC that takes a request id: a request that has an effect, and what must be there
// before it. Each row can be asked for as often as wanted, with a number that makes its resources
// its own.
#pragma once

#include <string>
#include <vector>

namespace truepose::testing {

// What no single call prepares.
enum class Stage {
  kNothing,
  kReadings,      // measured readings in the session $uuid
  kJobEnded,      // the jobs of before have ended
  kRunningJob,    // a job $uuid that runs until it is cancelled
  kSecondActive,  // another calibration of the robot was made active after the first
};

struct ReplayRow {
  std::string method;
  // Rows whose requests go first, with the same number.
  std::vector<std::string> before;
  Stage stage = Stage::kNothing;  // after those
  // $n = the number, $uuid and $table two UUIDs with it, $nominal a robot's, $changed_nominal
  // another one.
  std::string request;
};

// A new RPC gets a row here.
const std::vector<ReplayRow>& ReplayRows();
// nullptr when there is none.
const ReplayRow* FindReplayRow(const std::string& method);

}  // namespace truepose::testing
