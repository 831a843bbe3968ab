// Where worker threads wait: for work, for a pause to end, for the stop.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <mutex>

#include "absl/time/time.h"

namespace truepose::jobs {

class StopSignal {
 public:
  bool IsStopping() const { return stopping_; }
  void Stop();

  // Count of wakes so far: read it before looking for work, and a wake meanwhile isn't missed.
  uint64_t Wakes() const { return wakes_; }
  void Wake();
  // Waits for a wake after `seen`, or the stop.
  void WaitForWake(uint64_t seen);

  // Waits that long, or until the stop. @returns false when stopping.
  bool Pause(absl::Duration duration);

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<bool> stopping_ = false;  // written under the mutex
  std::atomic<uint64_t> wakes_ = 0;     // written under the mutex
};

}  // namespace truepose::jobs
