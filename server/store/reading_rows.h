// Rows of readings, for both ways to address them. Only for .cc files of this folder.
#pragma once

#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/base/fault.h"
#include "server/store/keys.h"
#include "server/store/reading_batch.h"
#include "server/store/transaction.h"

namespace truepose::store {

// A part of a batch and the rows it belongs to: reading first + i is in row first_row + i.
struct Placed {
  int first = 0;
  int count = 0;
  int first_row = 0;
};

// Adds a fault `readings[i].<field>` for each placed reading that is stored with other bytes.
// @returns kDataLoss when one isn't stored at all.
absl::Status CompareRows(Snapshot& snapshot, Key session, const ReadingBatch& batch, Placed placed,
                         std::string_view field, FaultList& faults);

// Stores the placed readings with the transaction's time.
// @returns kFailedPrecondition with a fault of `session` when that is sealed or deleted.
absl::Status InsertRows(Transaction& transaction, Key session, const ReadingBatch& batch,
                        Placed placed);

// How many readings the session holds: rows have no gaps.
absl::StatusOr<int> CountRows(Snapshot& snapshot, Key session);

}  // namespace truepose::store
