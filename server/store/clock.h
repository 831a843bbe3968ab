// The time, behind an interface so that tests turn it by hand.
#pragma once

#include "absl/time/time.h"

namespace truepose::store {

class Clock {
 public:
  virtual ~Clock() = default;
  // Wall time: written into resources, never compared to decide anything.
  virtual absl::Time Now() const = 0;
  // Time since an arbitrary start; never jumps. For leases and deadlines.
  virtual absl::Duration Monotonic() const = 0;
};

// The system's clock; lives as long as the process. Safe from any thread.
const Clock& RealClock();

}  // namespace truepose::store
