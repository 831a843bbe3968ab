// Readings of a session: rows from 0 without gaps, written once. Addressed by their rows here, by
// source and sequence in reading_sources.h.
#pragma once

#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "server/store/page.h"
#include "server/store/reading_batch.h"
#include "server/store/transaction.h"
#include "truepose/v1/session.pb.h"

namespace truepose::store {

// Appends a batch; a row that is stored with the same bytes is accepted again, also after sealing.
// Nothing of a batch with a fault is stored; the faults name `readings[i].row`.
// @returns the number of readings now stored; kNotFound; kOutOfRange with a fault for a gap before
// or within the
//   batch; kAborted with a fault for each row that is stored with other bytes; kFailedPrecondition
//   for new rows of a sealed or deleted session.
absl::StatusOr<int> AppendReadings(Transaction& transaction, std::string_view session_name,
                                   const ReadingBatch& batch);

// By row, with the time at which each was stored; 1000 a page, at most 10000.
absl::StatusOr<Page<v1::Reading>> ListReadings(Snapshot& snapshot, std::string_view session_name,
                                               const PageRequest& request);
// As they were measured: without server_time.
absl::StatusOr<std::vector<v1::Reading>> AllReadings(Snapshot& snapshot,
                                                     std::string_view session_name);

}  // namespace truepose::store
