// SQLite behind the seam.
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "server/store/sql/connection.h"

namespace truepose::store::sql {

// Opens `path` (":memory:" is a private database). kWrite creates and marks an empty file; kRead
// refuses writes. A transaction is on the disk when its COMMIT returns (WAL, synchronous = FULL);
// foreign keys are enforced.
// @returns kFailedPrecondition with a fault (field = path) for a file that is no database, is
// another program's, or
//   can't be written; it is unchanged then.
absl::StatusOr<std::unique_ptr<Connection>> OpenSqlite(const std::string& path, Access access);

}  // namespace truepose::store::sql
