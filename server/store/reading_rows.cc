#include "server/store/reading_rows.h"

#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "server/store/message.h"
#include "server/store/session_row.h"
#include "server/store/sql/query.h"

namespace truepose::store {
namespace {

absl::Status CheckOpen(Snapshot& snapshot, Key key) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Session session, ReadSessionMessage(snapshot, key));
  if (session.has_delete_time()) {
    return Refusal(absl::StatusCode::kFailedPrecondition, "session",
                   absl::StrCat(session.name(), ", which is deleted"),
                   "a session that is not; undelete it, then send again");
  }
  if (session.state() == v1::OPEN) return absl::OkStatus();
  return Refusal(absl::StatusCode::kFailedPrecondition, "session",
                 absl::StrCat(session.name(), ", which is sealed"), "an open session");
}

}  // namespace

absl::Status CompareRows(Snapshot& snapshot, Key session, const ReadingBatch& batch, Placed placed,
                         std::string_view field, FaultList& faults) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto stored,
      sql::Query(snapshot.sql(),
                 "SELECT message FROM readings WHERE session = $1 AND row_index = $2", session, 0));
  std::string buffer;
  for (int i = 0; i < placed.count; ++i) {
    const int row = placed.first_row + i;
    stored->Reset();
    stored->BindInt64(2, row);
    TRUEPOSE_ASSIGN_OR_RETURN(const bool found, stored->Step());
    if (!found) return absl::DataLossError(absl::StrCat("reading ", row, " is missing"));
    if (stored->Blob(0) == batch.Encoded(placed.first + i, row, buffer)) continue;
    faults.Add(absl::StrCat("readings[", placed.first + i, "].", std::string(field)),
               absl::StrCat("another reading than the stored row ", row),
               "the same reading, or a new row");
  }
  return absl::OkStatus();
}

absl::Status InsertRows(Transaction& transaction, Key session, const ReadingBatch& batch,
                        Placed placed) {
  TRUEPOSE_RETURN_IF_ERROR(CheckOpen(transaction, session));
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto insert,
      sql::Query(transaction.sql(),
                 "INSERT INTO readings (session, row_index, message, server_time) VALUES "
                 "($1, $2, $3, $4)",
                 session, 0, sql::BlobView{}, absl::ToUnixMicros(transaction.now())));
  std::string buffer;
  for (int i = 0; i < placed.count; ++i) {
    const int row = placed.first_row + i;
    insert->Reset();
    insert->BindInt64(2, row);
    insert->BindBlob(3, batch.Encoded(placed.first + i, row, buffer));
    TRUEPOSE_RETURN_IF_ERROR(insert->Step().status());
  }
  return absl::OkStatus();
}

absl::StatusOr<int> CountRows(Snapshot& snapshot, Key session) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      const int64_t count,
      sql::QueryInt64(snapshot.sql(),
                      "SELECT COALESCE(MAX(row_index) + 1, 0) FROM readings WHERE session = $1",
                      session));
  return static_cast<int>(count);
}

}  // namespace truepose::store
