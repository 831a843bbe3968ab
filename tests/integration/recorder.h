// A client that follows a plant by one watch after another and keeps what it heard.
#pragma once

#include <atomic>
#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "absl/time/time.h"
#include "truepose/v1/watch.pb.h"

namespace truepose::testing {

// Where a watch begins.
struct WatchPosition {
  std::string epoch;
  int64_t revision = 0;
};

// Where the store is now.
WatchPosition PositionNow(const std::string& address);

struct Heard {
  int64_t revision = 0;
  std::string name;
  auto operator<=>(const Heard&) const = default;
};

struct Habits {
  absl::Duration pause = absl::ZeroDuration();  // after each message
  int hang_up_after = 0;                        // messages of one watch; 0 = never by itself
};

// Follows from `begin` until an event of the resource `last` has come, across all breaks of the
// server, which it looks for again for half a minute. Fails the test when a response steps back or
// another store answers.
// @returns every event, in the order in which it came.
std::vector<Heard> Record(const std::string& address, WatchPosition begin, const std::string& last,
                          const Habits& habits);

}  // namespace truepose::testing
