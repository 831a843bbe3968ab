#include "server/store/readings.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/store/keys.h"
#include "server/store/list.h"
#include "server/store/message.h"
#include "server/store/reading_rows.h"
#include "server/store/sql/query.h"

namespace truepose::store {
namespace {

std::string RowField(int index) { return absl::StrCat("readings[", index, "].row"); }

// The first row may be stored already, but must not be beyond the next; the others follow one by
// one.
absl::Status CheckRows(const ReadingBatch& batch, int stored) {
  FaultList faults;
  for (int i = 0; i < batch.size(); ++i) {
    const int row = batch.row(i);
    const bool first = i == 0;
    const bool fits = first ? row >= 0 && row <= stored : row == batch.row(0) + i;
    if (fits) continue;
    faults.Add(
        RowField(i), absl::StrCat(row),
        first ? absl::StrCat("0 to ", stored, ", the next row") : absl::StrCat(batch.row(0) + i));
  }
  return faults.ToStatus(absl::StatusCode::kOutOfRange);
}

// With the time, which stands beside the message: the same reading sent again has the same bytes.
absl::StatusOr<v1::Reading> ReadTimed(const sql::Statement& row) {
  absl::StatusOr<v1::Reading> reading = ReadMessage<v1::Reading>(row, 1);
  const int64_t time = row.Int64(2);
  if (reading.ok() && time != 0) {
    *reading->mutable_server_time() = ToTimestamp(absl::FromUnixMicros(time));
  }
  return reading;
}

}  // namespace

absl::StatusOr<int> AppendReadings(Transaction& transaction, std::string_view session_name,
                                   const ReadingBatch& batch) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Key key, SessionKey(transaction, session_name, "session"));
  TRUEPOSE_ASSIGN_OR_RETURN(const int stored, CountRows(transaction, key));
  TRUEPOSE_RETURN_IF_ERROR(CheckRows(batch, stored));
  if (batch.empty()) return stored;
  const int first_row = batch.row(0);
  const int repeats = std::min(stored - first_row, batch.size());
  FaultList faults;
  TRUEPOSE_RETURN_IF_ERROR(
      CompareRows(transaction, key, batch, {0, repeats, first_row}, "row", faults));
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus(absl::StatusCode::kAborted));
  const int added = batch.size() - repeats;
  if (added == 0) return stored;
  TRUEPOSE_RETURN_IF_ERROR(InsertRows(transaction, key, batch, {repeats, added, stored}));
  return stored + added;
}

absl::StatusOr<Page<v1::Reading>> ListReadings(Snapshot& snapshot, std::string_view session_name,
                                               const PageRequest& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Key key, SessionKey(snapshot, session_name, "session"));
  const ListId id{"readings", std::string(session_name)};
  TRUEPOSE_ASSIGN_OR_RETURN(const PageStart start,
                            CheckPage(id, request, {.default_size = 1000, .max_size = 10000}));
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t after, AfterNumber(start, -1));
  TRUEPOSE_ASSIGN_OR_RETURN(auto rows, sql::Query(snapshot.sql(),
                                                  "SELECT row_index, message, server_time FROM "
                                                  "readings WHERE session = $1 AND row_index > $2 "
                                                  "ORDER BY row_index LIMIT $3",
                                                  key, after, start.size + 1));
  return ReadPage<v1::Reading>(id, start.size, *rows, ReadTimed);
}

absl::StatusOr<std::vector<v1::Reading>> AllReadings(Snapshot& snapshot,
                                                     std::string_view session_name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Key key, SessionKey(snapshot, session_name, "session"));
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto rows,
      sql::Query(snapshot.sql(),
                 "SELECT message FROM readings WHERE session = $1 ORDER BY row_index", key));
  std::vector<v1::Reading> readings;
  for (;;) {
    TRUEPOSE_ASSIGN_OR_RETURN(const bool found, rows->Step());
    if (!found) return readings;
    TRUEPOSE_ASSIGN_OR_RETURN(v1::Reading reading, ReadMessage<v1::Reading>(*rows, 0));
    readings.push_back(std::move(reading));
  }
}

}  // namespace truepose::store
