#include "server/store/table_files.h"

#include <string>

#include "core/base/status_macros.h"
#include "server/store/files.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/sql/query.h"
#include "truepose/v1/watch.pb.h"

namespace truepose::store {
namespace {

constexpr int64_t kThere = 0, kGone = -1;

// A digest of which some table is due and none is there, or deleted less long ago.
constexpr char kDue[] =
    "SELECT COALESCE((SELECT sha256 FROM table_files AS due WHERE deleted_us > 0 AND deleted_us <= "
    "$1 AND NOT EXISTS (SELECT 1 FROM table_files AS other WHERE other.sha256 = due.sha256 AND "
    "(other.deleted_us = 0 OR other.deleted_us > $1)) LIMIT 1), '')";

absl::StatusOr<std::string> DueFile(Snapshot& snapshot, absl::Time now) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto row, sql::Query(snapshot.sql(), kDue, absl::ToUnixMicros(now - kKeepDeletedFiles)));
  TRUEPOSE_RETURN_IF_ERROR(row->Step().status());
  return row->Text(0);
}

}  // namespace

absl::Status NoteTableFile(Transaction& transaction, const v1::CompensationTable& table) {
  if (table.sha256().empty()) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(const TableName name, ParseTableName(table.name()));
  const int64_t deleted_us =
      table.has_delete_time() ? absl::ToUnixMicros(ToTime(table.delete_time())) : kThere;
  return sql::Run(transaction.sql(),
                  "INSERT INTO table_files (resource, sha256, deleted_us) SELECT sequence, $4, $5 "
                  "FROM resources WHERE kind = $1 AND robot_id = $2 AND id = $3 ON CONFLICT "
                  "(resource) DO UPDATE SET sha256 = excluded.sha256, deleted_us = "
                  "excluded.deleted_us",
                  static_cast<int>(v1::KIND_COMPENSATION_TABLE), name.robot_id, name.id,
                  table.sha256(), deleted_us);
}

absl::StatusOr<bool> HasFilesToForget(Snapshot& snapshot, absl::Time now) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string due, DueFile(snapshot, now));
  return !due.empty();
}

absl::StatusOr<bool> ForgetFile(Transaction& transaction) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string due, DueFile(transaction, transaction.now()));
  if (due.empty()) return false;
  TRUEPOSE_RETURN_IF_ERROR(DropFile(transaction, due));
  TRUEPOSE_RETURN_IF_ERROR(sql::Run(
      transaction.sql(), "UPDATE table_files SET deleted_us = $2 WHERE sha256 = $1", due, kGone));
  return true;
}

}  // namespace truepose::store
