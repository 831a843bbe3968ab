// Which compensation table has which file, and when the bytes of a deleted one go: as long as
// answers to requests are kept after its deletion, unless another table has the same ones.
#pragma once

#include <cstdint>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "server/store/transaction.h"
#include "truepose/v1/compensation_table.pb.h"

namespace truepose::store {

// A table that was deleted can be brought back for so long.
inline constexpr absl::Duration kKeepDeletedFiles = absl::Hours(7 * 24);

// After a READY table was built, deleted or brought back, in the same commit. Nothing for a table
// without a file. @returns kInvalidArgument for the form of the name.
absl::Status NoteTableFile(Transaction& transaction, const v1::CompensationTable& table);

// Whether there are bytes to forget: a look before a write.
absl::StatusOr<bool> HasFilesToForget(Snapshot& snapshot, absl::Time now);

// Forgets the bytes of one file that no table needs any more; the tables stay, deleted, and can't
// be brought back. @returns whether there was one.
absl::StatusOr<bool> ForgetFile(Transaction& transaction);

}  // namespace truepose::store
