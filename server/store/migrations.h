// Brings a database to the newest form, forward only.
//
// A migration is a numbered text of SQL whose first line is `-- min_compatible: N`: a program that
// knows the migrations up to N can still work with the database afterwards. Each is applied in one
// transaction together with its row in the table `migrations` (number, name, SHA-256 of its text)
// and the schema version, so that an interruption leaves the version before it.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "server/store/clock.h"
#include "server/store/sql/connection.h"

namespace truepose::store {

struct Migration {
  int number;  // from 1, without gaps
  std::string_view name;
  std::string_view sql;
};

// Those of migrations/, embedded by the build.
std::span<const Migration> EmbeddedMigrations();

// Applies what is missing. A database with further migrations is left as it is when their
// min_compatible allows.
// @param known in the order of numbers, from 1 without gaps.
// @param field names the database in faults.
// @returns kFailedPrecondition with a fault when the database is newer and not compatible, or when
// an applied
//   migration has another text now; the error of a migration that failed, the database then at the
//   version before it.
absl::Status Migrate(sql::Connection& connection, std::span<const Migration> known,
                     const Clock& clock, const std::string& field);

}  // namespace truepose::store
