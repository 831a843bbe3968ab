// Finds in a stream of readings those that were taken while the robot stood still.
#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "absl/time/time.h"
#include "truepose/v1/session.pb.h"

namespace truepose::agent {

struct SettleOptions {
  std::chrono::milliseconds still{500};  // so long no joint may have moved
  double tolerance = 1e-4;               // rad or m: what counts as not moved
};

// One reading of each standstill: the first with a measurement after all joints stayed within the
// tolerance of where they were when they came to rest, for the whole time. Joints are the measured
// ones, else those commanded. Decided by the readings' own times, so that the same stream gives the
// same readings however fast it is read.
class Settled {
 public:
  explicit Settled(const SettleOptions& options) : options_(options) {}

  // Whether that reading is the one of its standstill. A time before that of the reading before
  // begins anew.
  bool Add(const v1::Reading& reading, absl::Time time);

 private:
  bool IsNear(const std::vector<double>& joints) const;

  const SettleOptions options_;
  std::vector<double> rest_;  // where the joints came to rest
  absl::Time since_ = absl::InfinitePast(), last_ = absl::InfinitePast();
  bool taken_ = false;
};

// The reading's time, ISO 8601 with offset; nullopt when it has none or another form.
std::optional<absl::Time> TimeOf(const v1::Reading& reading);

}  // namespace truepose::agent
