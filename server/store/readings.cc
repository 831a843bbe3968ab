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
#include "server/store/session_row.h"
#include "server/store/sql/query.h"

namespace truepose::store {
namespace {

using Readings = google::protobuf::RepeatedPtrField<v1::Reading>;

std::string RowField(int index) { return absl::StrCat("readings[", index, "].row"); }

// The first row may be stored already, but must not be beyond the next; the others follow one by
// one.
absl::Status CheckRows(const Readings& readings, int stored) {
  FaultList faults;
  for (int i = 0; i < readings.size(); ++i) {
    const int row = readings[i].row();
    const bool first = i == 0;
    const bool fits = first ? row >= 0 && row <= stored : row == readings[0].row() + i;
    if (fits) continue;
    faults.Add(RowField(i), absl::StrCat(row),
               first ? absl::StrCat("0 to ", stored, ", the next row")
                     : absl::StrCat(readings[0].row() + i));
  }
  return faults.ToStatus(absl::StatusCode::kOutOfRange);
}

// Rows [0, count) of the batch that are stored already have to be the same.
absl::Status CheckRepeats(Snapshot& snapshot, Key session, const Readings& readings, int count) {
  FaultList faults;
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto row,
      sql::Query(snapshot.sql(),
                 "SELECT message FROM readings WHERE session = $1 AND row_index = $2", session, 0));
  for (int i = 0; i < count; ++i) {
    row->Reset();
    row->BindInt64(2, readings[i].row());
    TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
    if (!found)
      return absl::DataLossError(absl::StrCat("reading ", readings[i].row(), " is missing"));
    if (row->Blob(0) == ToBlob(readings[i])) continue;
    faults.Add(RowField(i), absl::StrCat("another reading than the stored row ", readings[i].row()),
               "the same reading, or a new row");
  }
  return faults.ToStatus(absl::StatusCode::kAborted);
}

absl::Status InsertFrom(Transaction& transaction, Key session, const Readings& readings,
                        int first) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto insert,
      sql::Query(transaction.sql(),
                 "INSERT INTO readings (session, row_index, message) VALUES ($1, $2, $3)",
                 session));
  for (int i = first; i < readings.size(); ++i) {
    insert->Reset();
    insert->BindInt64(2, readings[i].row());
    insert->BindBlob(3, ToBlob(readings[i]));
    TRUEPOSE_RETURN_IF_ERROR(insert->Step().status());
  }
  return absl::OkStatus();
}

absl::StatusOr<v1::Reading> ReadReading(const sql::Statement& row) {
  return ReadMessage<v1::Reading>(row, 1);
}

}  // namespace

absl::StatusOr<int> AppendReadings(Transaction& transaction, std::string_view session_name,
                                   const Readings& readings) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Key key, SessionKey(transaction, session_name, "session"));
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Session session, ReadSession(transaction, key));
  const int stored = session.reading_count();
  TRUEPOSE_RETURN_IF_ERROR(CheckRows(readings, stored));
  const int repeats = readings.empty() ? 0 : std::min(stored - readings[0].row(), readings.size());
  TRUEPOSE_RETURN_IF_ERROR(CheckRepeats(transaction, key, readings, repeats));
  if (repeats == readings.size()) return stored;
  if (session.state() != v1::OPEN) {
    return Refusal(absl::StatusCode::kFailedPrecondition, "session",
                   absl::StrCat(session.name(), ", which is sealed"), "an open session");
  }
  TRUEPOSE_RETURN_IF_ERROR(InsertFrom(transaction, key, readings, repeats));
  session.set_reading_count(stored + readings.size() - repeats);
  TRUEPOSE_RETURN_IF_ERROR(UpdateSession(transaction, session));
  return session.reading_count();
}

absl::StatusOr<Page<v1::Reading>> ListReadings(Snapshot& snapshot, std::string_view session_name,
                                               const PageRequest& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Key key, SessionKey(snapshot, session_name, "session"));
  const ListId id{"readings", std::string(session_name)};
  TRUEPOSE_ASSIGN_OR_RETURN(const PageStart start,
                            CheckPage(id, request, {.default_size = 1000, .max_size = 10000}));
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t after, AfterNumber(start, -1));
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto rows,
      sql::Query(snapshot.sql(),
                 "SELECT row_index, message FROM readings WHERE session = $1 AND row_index > $2 "
                 "ORDER BY row_index LIMIT $3",
                 key, after, start.size + 1));
  return ReadPage<v1::Reading>(id, start.size, *rows, ReadReading);
}

absl::StatusOr<std::vector<v1::Reading>> AllReadings(Snapshot& snapshot,
                                                     std::string_view session_name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Key key, SessionKey(snapshot, session_name, "session"));
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto rows,
      sql::Query(snapshot.sql(),
                 "SELECT row_index, message FROM readings WHERE session = $1 ORDER BY row_index",
                 key));
  std::vector<v1::Reading> readings;
  for (;;) {
    TRUEPOSE_ASSIGN_OR_RETURN(const bool found, rows->Step());
    if (!found) return readings;
    TRUEPOSE_ASSIGN_OR_RETURN(v1::Reading reading, ReadReading(*rows));
    readings.push_back(std::move(reading));
  }
}

}  // namespace truepose::store
