#include "server/store/migrations.h"

#include <cstdint>
#include <memory>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"
#include "absl/time/time.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/store/checksum.h"
#include "server/store/sql/query.h"
#include "server/store/sql/transaction.h"

namespace truepose::store {
namespace {

absl::StatusOr<int64_t> MinCompatible(const Migration& migration) {
  const std::string first(migration.sql.substr(0, migration.sql.find('\n')));
  absl::string_view line = first;
  int64_t number = 0;
  if (!absl::ConsumePrefix(&line, "-- min_compatible: ") || !absl::SimpleAtoi(line, &number)) {
    return absl::InternalError(absl::StrCat("migration ", migration.number, " (",
                                            std::string(migration.name),
                                            "): the first line isn't `-- min_compatible: N`"));
  }
  return number;
}

absl::Status Refuse(const std::string& field, std::string found, std::string expected) {
  FaultList faults;
  faults.Add(field, std::move(found), std::move(expected));
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

absl::Status CheckNewer(sql::Connection& connection, int64_t version, int64_t newest,
                        const std::string& field) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      const int64_t needed,
      sql::QueryInt64(connection, "SELECT COALESCE(MAX(min_compatible), 0) FROM migrations"));
  if (needed <= newest) return absl::OkStatus();
  return Refuse(
      field, absl::StrCat("a database of version ", version, ", made by a newer Truepose"),
      absl::StrCat("version ", newest, " or older, or a Truepose that knows version ", needed));
}

// A text that was changed after it was applied means that two databases of one version differ.
absl::Status CheckChecksums(sql::Connection& connection, std::span<const Migration> known,
                            const std::string& field) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      const std::unique_ptr<sql::Statement> row,
      sql::Query(connection,
                 "SELECT number, name, sha256 FROM migrations WHERE number BETWEEN 1 AND $1",
                 known.size()));
  for (;;) {
    TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
    if (!found) return absl::OkStatus();
    const std::string expected = Sha256Hex(known[row->Int64(0) - 1].sql);
    if (row->Text(2) == expected) continue;
    return Refuse(field,
                  absl::StrCat("migration ", row->Int64(0), " (", row->Text(1), ") with checksum ",
                               row->Text(2)),
                  absl::StrCat("checksum ", expected));
  }
}

absl::Status Apply(sql::Connection& connection, const Migration& migration, const Clock& clock) {
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t min_compatible, MinCompatible(migration));
  TRUEPOSE_ASSIGN_OR_RETURN(sql::Transaction transaction,
                            sql::Transaction::Begin(connection, sql::Access::kWrite));
  TRUEPOSE_RETURN_IF_ERROR(connection.Execute(migration.sql));
  TRUEPOSE_RETURN_IF_ERROR(
      sql::Run(connection,
               "INSERT INTO migrations (number, name, sha256, min_compatible, applied_at) VALUES "
               "($1, $2, $3, $4, $5)",
               migration.number, migration.name, Sha256Hex(migration.sql), min_compatible,
               absl::FormatTime(absl::RFC3339_sec, clock.Now(), absl::UTCTimeZone())));
  TRUEPOSE_RETURN_IF_ERROR(connection.SetSchemaVersion(migration.number));
  return transaction.Commit();
}

}  // namespace

absl::Status Migrate(sql::Connection& connection, std::span<const Migration> known,
                     const Clock& clock, const std::string& field) {
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t version, connection.SchemaVersion());
  const int64_t newest = static_cast<int64_t>(known.size());
  if (version > newest) TRUEPOSE_RETURN_IF_ERROR(CheckNewer(connection, version, newest, field));
  if (version > 0) TRUEPOSE_RETURN_IF_ERROR(CheckChecksums(connection, known, field));
  for (int64_t next = version; next < newest; ++next) {
    TRUEPOSE_RETURN_IF_ERROR(Apply(connection, known[next], clock));
  }
  return absl::OkStatus();
}

}  // namespace truepose::store
