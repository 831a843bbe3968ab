// What the engine runs: given by the composition root, so that jobs don't depend on convert or
// core.
#pragma once

#include <functional>

#include "absl/status/statusor.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::jobs {

struct RunnerHooks {
  // May be called from the running thread at any time; doesn't block.
  std::function<void(const v1::JobProgress&)> on_progress;
  // True asks the runner to end soon with kCancelled: cancelled, past its deadline, or the engine
  // stops.
  std::function<bool()> is_cancelled;
};

// Turns the frozen input into a result, without name, job and create_time. Runs on a worker thread,
// several at once.
using Runner =
    std::function<absl::StatusOr<v1::Calibration>(const v1::CalibrationInput&, const RunnerHooks&)>;

}  // namespace truepose::jobs
