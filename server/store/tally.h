// How much of everything a store holds, for the server's status.
#pragma once

#include <cstdint>

#include "absl/status/statusor.h"
#include "server/store/transaction.h"

namespace truepose::store {

struct Tally {
  int64_t robots = 0;    // that are not deleted
  int64_t sessions = 0;  // that are not deleted
  int64_t readings = 0;  // of all sessions
  int64_t pending_jobs = 0;
  int64_t running_jobs = 0;
  int64_t open_requests = 0;  // for a recalibration
};

// Reads index entries, never a reading: the rows of a session count from 0 without gaps, so that
// its last one says how many there are. Requests are read one by one.
absl::StatusOr<Tally> CountAll(Snapshot& snapshot);

}  // namespace truepose::store
