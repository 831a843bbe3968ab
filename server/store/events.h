// What changed with which commit: the history that watches are served from.
//
// An event is a whole resource after a change. Events of one commit share its revision and are told
// together, in the order in which they were recorded. A repository records an event in the
// transaction of the change itself, so there is one exactly when the change is stored.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "google/protobuf/message_lite.h"
#include "server/store/transaction.h"
#include "truepose/v1/watch.pb.h"

namespace truepose::store {

struct ChangedResource {
  v1::ResourceKind kind;
  std::string robot_id;  // "" = of the plant
  std::string name;
  bool deleted = false;
};

absl::Status RecordEvent(Transaction& transaction, const ChangedResource& changed,
                         const google::protobuf::MessageLite& resource);

// What a watcher wants to see.
struct EventFilter {
  std::string robot_id;              // "" = all, also what belongs to no robot
  std::set<v1::ResourceKind> kinds;  // none = all
  std::string name;                  // "" = all
};

struct EventBatch {
  std::vector<v1::WatchEvent> events;
  int64_t revision = 0;   // every event up to it is in this batch or before it
  bool has_more = false;  // the history goes on after `revision`
};

// Whole commits after `after`, until there are `most_events` events or `most_bytes` bytes; at least
// one commit.
// @returns kOutOfRange when the history no longer reaches back to `after`, or `after` is later than
// the store's last commit (another store).
absl::StatusOr<EventBatch> EventsAfter(Snapshot& snapshot, int64_t after, const EventFilter& filter,
                                       int most_events, int64_t most_bytes);

// The event as watchers see it. @returns kDataLoss when the message isn't one of `kind`.
absl::StatusOr<v1::WatchEvent> ToWatchEvent(int64_t revision, const ChangedResource& changed,
                                            const std::string& message);

struct EventHistory {
  absl::Duration age = absl::Hours(24);
  int64_t count = 1'000'000;
};

// Whether there are events over the history's age or count: a look before a write.
absl::StatusOr<bool> HasEventsToForget(Snapshot& snapshot, const EventHistory& history,
                                       absl::Time now);

// Forgets at most `most` of the oldest events that are over the history's age or count, commit by
// commit.
// @returns how many.
absl::StatusOr<int64_t> ForgetEvents(Transaction& transaction, const EventHistory& history,
                                     int64_t most);

}  // namespace truepose::store
