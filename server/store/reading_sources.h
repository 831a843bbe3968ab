// Readings addressed by where they come from: a source is a UUID made with a client's spool, and
// its readings are numbered from 1 without gaps, whatever sessions they belong to.
//
// What is stored of a source is always its readings 1 to durable_sequence, in the same transaction
// as the readings themselves, so a client that lost its answer, or whose server was restored from
// an older copy, learns here where to go on.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "server/store/reading_batch.h"
#include "server/store/transaction.h"

namespace truepose::store {

struct SourceBatch {
  std::string source;          // a UUID
  int64_t first_sequence = 1;  // of the first reading; the others follow
  std::string session;         // sessions/{id}
  ReadingBatch readings;
};

struct SourceProgress {
  int reading_count = 0;         // in the session, after the batch
  int64_t durable_sequence = 0;  // of the source, after the batch
};

// Appends what is new of the batch behind the session's last row. What is stored already is
// compared: the same readings are accepted again, also after sealing.
// @returns kNotFound for a session that was never created, or is not in a restored store any more;
//   kOutOfRange with a fault of `first_sequence` and the error metadata `expected_sequence` for a
//   gap; kAborted with a fault `readings[i].sequence` for each reading that is stored with another
//   content or in another session; kFailedPrecondition for new readings of a sealed or
//   deleted session.
//   Nothing of the batch is stored then.
absl::StatusOr<SourceProgress> AppendFromSource(Transaction& transaction, const SourceBatch& batch);

// kNotFound with a fault of `session` that says what to do: sessions are made offline, with ids of
// their clients, so the client has it and can create it here.
absl::Status UnknownSession(std::string_view session);

// The highest sequence of the source that is stored; 0 for one that never sent anything.
absl::StatusOr<int64_t> DurableSequence(Snapshot& snapshot, std::string_view source);

}  // namespace truepose::store
