// Does what a server does by itself: each task every so often, one after another on one thread.
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "server/store/clock.h"

namespace truepose::server {

class Scheduler {
 public:
  struct Task {
    std::string what;  // for warnings: "old events can't be forgotten"
    // Ends early once its argument answers true.
    std::function<absl::Status(const std::function<bool()>& is_stopping)> run;
  };

  // @param every of the clock's monotonic time, from the begin of one round to the next; the first
  // is at once. @param on_warning is told `what` and the error of a task that failed; it runs again
  // with the next round.
  Scheduler(std::vector<Task> tasks, absl::Duration every, const store::Clock& clock,
            std::function<void(const std::string&)> on_warning);
  // Stop().
  ~Scheduler();

  void Start();
  // Waits until the task that runs has ended, which it is told to. May be called again.
  void Stop();

 private:
  void Loop();
  void RunAll();
  bool WaitUntil(absl::Duration due);
  bool IsStopping();

  const std::vector<Task> tasks_;
  const absl::Duration every_;
  const store::Clock& clock_;
  const std::function<void(const std::string&)> on_warning_;
  std::mutex mutex_;
  std::condition_variable stop_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace truepose::server
