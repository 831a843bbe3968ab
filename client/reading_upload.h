// Uploads what a spool holds, addressed by (source, sequence), so that each reading arrives once
// however often connection, server or client break off.
//
// A source is a UUID that is made with its spool and never used for another one. Its readings count
// from 1 over all sessions. Who makes sessions offline creates them on the server before their
// readings are sent.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/client.h"
#include "truepose/v1/session.pb.h"

namespace truepose::client {

// Consecutive readings of one session; their rows don't matter.
struct SpooledReadings {
  std::string session;  // sessions/{uuid}
  std::vector<v1::Reading> readings;
};

// Where readings wait until they are durable on the server. Read and SetDurable come from two
// threads at once.
class ReadingSpool {
 public:
  virtual ~ReadingSpool() = default;
  // Sequence of the newest reading; 0 before the first.
  virtual int64_t last_sequence() const = 0;
  // At least 1 and at most `most` readings from `sequence` (at most last_sequence()) on, up to
  // where the session changes. Readings that were given before have to be the same again.
  // @returns an error when the spool has them no more; it ends the upload.
  virtual absl::StatusOr<SpooledReadings> Read(int64_t sequence, int most) = 0;
  // The server holds everything up to here. It may fall back when the server is restored from an
  // older copy, so what was durable is worth keeping for as long as such copies are.
  virtual void SetDurable(int64_t sequence) = 0;
};

struct ReadingUploadOptions {
  int batch_size = 100;       // readings; at most 10000
  int batches_in_flight = 8;  // sent before their acknowledgements are awaited
  // How long the server may stay away before the upload is given up. Counted anew from each
  // acknowledgement.
  std::chrono::milliseconds patience{30'000};

  // Every fault at once, with the option's name as field.
  absl::Status Validate() const;
};

// Sends what `spool` holds when this is called, from where the server says that it has everything,
// and returns the server's durable sequence then, which is at least the spool's. Connects again
// while the server stays away for less than the patience.
// @returns kNotFound for a session that the server doesn't know (any more): create it and call
//   again; kFailedPrecondition when the server holds more of the source than the spool ever had, or
//   when new readings are for a sealed session; kAborted when a sequence is stored with another
//   content; kInvalidArgument with faults of readings or options; kUnavailable when the server
//   stays away; what the spool answers. What was acknowledged stays stored.
absl::StatusOr<int64_t> UploadSpool(const Client& client, const std::string& source,
                                    ReadingSpool& spool, const ReadingUploadOptions& options = {});

}  // namespace truepose::client
