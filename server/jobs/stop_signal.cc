#include "server/jobs/stop_signal.h"

namespace truepose::jobs {

void StopSignal::Stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
}

void StopSignal::Wake() {
  {
    const std::lock_guard lock(mutex_);
    ++wakes_;
  }
  changed_.notify_all();
}

void StopSignal::WaitForWake(uint64_t seen) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return stopping_ || wakes_ != seen; });
}

bool StopSignal::Pause(absl::Duration duration) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, absl::ToChronoMicroseconds(duration), [&] { return stopping_.load(); });
  return !stopping_;
}

}  // namespace truepose::jobs
