// Compensation tables where jobs build them: their frozen input, and what a job leaves. As
// resources they live in resources.h; which calibration may have one, and which one acts on a
// robot, is decided above (server/services/table_jobs.h).
#pragma once

#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/store/transaction.h"
#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/compensation_table.pb.h"

namespace truepose::store {

// The file of a table as its builder made it.
struct TableFile {
  std::string bytes;
  std::string sha256;  // of the bytes, lower-case hex
  v1::CompensationTableHeader header;
};

// Also a deleted one. @returns kInvalidArgument for the form of the name, kNotFound.
absl::StatusOr<v1::CompensationTable> GetTable(Snapshot& snapshot, std::string_view name);

// Writes a new state of a table that is there, with update_time, revision and etag of this commit,
// and records the event.
absl::Status PutTable(Transaction& transaction, v1::CompensationTable& table);

// All that the job needs to build its table. Nothing of it changes after the job was created: a
// table's calibration and spec, a calibration and a nominal revision are immutable.
absl::StatusOr<v1::CompensationTableInput> LoadTableInput(Snapshot& snapshot,
                                                          const v1::CalibrationJob& job);

// BUILDING -> READY with its file. @returns the table; kNotFound.
absl::StatusOr<v1::CompensationTable> FinishTable(Transaction& transaction,
                                                  const v1::CalibrationJob& job,
                                                  const TableFile& file);

}  // namespace truepose::store
