// A clock that stands still until a test moves it.
#pragma once

#include <mutex>

#include "server/store/clock.h"

namespace truepose::store {

class FakeClock : public Clock {
 public:
  absl::Time Now() const override {
    const std::lock_guard lock(mutex_);
    return now_;
  }
  absl::Duration Monotonic() const override {
    const std::lock_guard lock(mutex_);
    return monotonic_;
  }
  // Both times go on.
  void Advance(absl::Duration duration) {
    const std::lock_guard lock(mutex_);
    now_ += duration;
    monotonic_ += duration;
  }
  // Somebody sets the wall clock; the monotonic one doesn't notice.
  void JumpWall(absl::Duration duration) {
    const std::lock_guard lock(mutex_);
    now_ += duration;
  }

 private:
  mutable std::mutex mutex_;
  absl::Time now_ = absl::FromUnixSeconds(1'700'000'000);
  absl::Duration monotonic_ = absl::Seconds(1000);
};

}  // namespace truepose::store
