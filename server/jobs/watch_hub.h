// Brings changes of jobs to their watchers, from one thread. Holds no state of a job: it is read
// when it is told, so that changes which come too fast melt into one.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "server/jobs/watch.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::jobs {

class WatchHub {
 public:
  using Load = std::function<absl::StatusOr<v1::CalibrationJob>(const std::string& name)>;

  // @param load reads a job as it is now; called from the hub's thread.
  explicit WatchHub(Load load);
  // Stop().
  ~WatchHub();

  // nullptr after Stop(). The subscription may outlive the hub.
  std::unique_ptr<Subscription> Add(std::string name, WatchCallbacks callbacks);
  // Something of this job has changed. Quick; from any thread.
  void Changed(const std::string& name);
  // Ends every watch with kUnavailable and waits for it. Not from a callback.
  void Stop();

 private:
  class Loop;
  std::shared_ptr<Loop> loop_;
};

}  // namespace truepose::jobs
