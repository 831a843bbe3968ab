// The time, behind an interface so that tests turn it by hand.
#pragma once

#include "absl/time/time.h"

namespace truepose::store {

class Clock {
 public:
  virtual ~Clock() = default;
  // Wall time: written into resources. Decides nothing but whether a time that somebody gave as a
  // date (the deadline of a job) has come.
  virtual absl::Time Now() const = 0;
  // Time since an arbitrary start; never jumps. For leases and deadlines.
  virtual absl::Duration Monotonic() const = 0;
};

// The system's clock; lives as long as the process. Safe from any thread.
const Clock& RealClock();

}  // namespace truepose::store
