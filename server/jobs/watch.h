// Tells watchers of a job how it goes, from one thread of its own.
#pragma once

#include <functional>
#include <memory>

#include "absl/status/status.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::jobs {

// Called one at a time, from the hub's thread, with no lock held; must not block (it would hold up
// other watchers).
struct WatchCallbacks {
  // The job now, then after each change of its state or progress. Changes that come faster than
  // they are taken are told as one; the last state always comes.
  std::function<void(const v1::CalibrationJob&)> on_job;
  // Once, last: OK after a terminal state, kUnavailable when the engine stops, or why the job
  // couldn't be read.
  std::function<void(const absl::Status&)> on_done;
};

// Ends a watch when destroyed: no callback runs or begins after that. May be destroyed from within
// a callback.
class Subscription {
 public:
  virtual ~Subscription() = default;
};

}  // namespace truepose::jobs
