// Uploads the readings of a session so that a lost connection costs at most the batches in flight.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/client.h"
#include "truepose/v1/session.pb.h"

namespace truepose::client {

struct AppendOptions {
  int batch_size = 1000;      // readings; the server takes at most 10000 and at most 16 MB
  int batches_in_flight = 4;  // written before their acknowledgements are awaited
  // How long the server may stay away before the upload is given up. Counted anew from each
  // acknowledgement.
  std::chrono::milliseconds patience{30'000};
  // After each acknowledgement: how many of `total` readings are safe in the store.
  std::function<void(int acknowledged, int total)> on_progress = {};
};

// Sends `readings` (rows 0, 1, 2...) to an open session and returns how many the session holds
// then: more than were sent when it held more before.
//
// After a broken connection it goes on behind the last acknowledged batch. A new call begins with
// row 0: the server compares what it has already and acknowledges it again, so a repeated call
// completes an upload of the same readings and can't mix those of two files.
// @returns kAborted when a stored row has another content; kFailedPrecondition when the session is
// sealed;
//   kInvalidArgument with faults of the readings or of the options; kUnavailable when the server
//   stays away. What was acknowledged stays stored in the open session.
absl::StatusOr<int> AppendReadings(const Client& client, const std::string& session,
                                   const std::vector<v1::Reading>& readings,
                                   const AppendOptions& options = {});

}  // namespace truepose::client
