// Uploads the readings of a session so that a lost connection costs at most the batches in flight.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/client.h"
#include "truepose/v1/session.pb.h"

namespace truepose::client {

struct AppendOptions {
  int batch_size = 1000;        // readings; the server takes at most 10000 and at most 16 MB
  int batches_in_flight = 4;    // written before their acknowledgements are awaited
  int attempts_without_progress = 5;  // connections in a row that acknowledged nothing
  // After each acknowledgement: how many of `total` readings are safe in the store.
  std::function<void(int acknowledged, int total)> on_progress;
};

// Sends `readings` (rows 0, 1, 2...) to an open session and returns how many the session holds then.
//
// Rows that the session has already are sent again from row 0 the first time, because the server compares them: a session begun
// from another file ends with kAborted and is not mixed. After a broken connection it asks the
// session for its reading_count and goes on from there.
// @returns kAborted when a stored row has another content; kFailedPrecondition when the session is sealed;
//   kInvalidArgument with faults of the readings; kUnavailable when the server stays away. Readings that were acknowledged
//   stay stored in the open session, and a later call with the same readings goes on.
absl::StatusOr<int> AppendReadings(const Client& client, const std::string& session,
                                   const std::vector<v1::Reading>& readings,
                                   const AppendOptions& options = {});

}  // namespace truepose::client
