#include "server/store/reading_sources.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/error_metadata.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/store/keys.h"
#include "server/store/message.h"
#include "server/store/reading_rows.h"
#include "server/store/sql/query.h"

namespace truepose::store {
namespace {

// A row of reading_runs.
struct Run {
  int64_t first_sequence = 0;
  Key session = 0;
  int first_row = 0;
  int count = 0;

  int64_t end() const { return first_sequence + count; }
  int end_row() const { return first_row + count; }
};

Run ReadRun(const sql::Statement& row) {
  return {row.Int64(0), row.Int64(1), static_cast<int>(row.Int64(2)),
          static_cast<int>(row.Int64(3))};
}

absl::StatusOr<std::optional<Run>> LastRun(Snapshot& snapshot, std::string_view source) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto row, sql::Query(snapshot.sql(),
                           "SELECT first_sequence, session, first_row, count FROM reading_runs "
                           "WHERE source = $1 ORDER BY first_sequence DESC LIMIT 1",
                           source));
  TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
  return found ? std::optional(ReadRun(*row)) : std::nullopt;
}

// The runs that hold the sequences [begin, end), which are all stored.
absl::StatusOr<std::vector<Run>> RunsOf(Snapshot& snapshot, std::string_view source, int64_t begin,
                                        int64_t end) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto row, sql::Query(snapshot.sql(),
                           "SELECT first_sequence, session, first_row, count FROM reading_runs "
                           "WHERE source = $1 AND first_sequence < $3 AND first_sequence >= "
                           "(SELECT MAX(first_sequence) FROM reading_runs WHERE source = $1 AND "
                           "first_sequence <= $2) ORDER BY first_sequence",
                           source, begin, end));
  std::vector<Run> runs;
  for (;;) {
    TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
    if (!found) return runs;
    runs.push_back(ReadRun(*row));
  }
}

absl::Status Gap(int64_t found, int64_t expected) {
  return WithErrorMetadata(
      Refusal(absl::StatusCode::kOutOfRange, "first_sequence", absl::StrCat(found),
              absl::StrCat("1 to ", expected, ", the next of this source")),
      "expected_sequence", absl::StrCat(expected));
}

absl::StatusOr<Key> SessionOf(Snapshot& snapshot, const SourceBatch& batch) {
  absl::StatusOr<Key> key = SessionKey(snapshot, batch.session, "session");
  if (!absl::IsNotFound(key.status())) return key;
  return UnknownSession(batch.session);
}

// The first `repeats` readings of the batch have to be the stored ones.
absl::Status CheckRepeats(Snapshot& snapshot, const SourceBatch& batch, Key session, int repeats) {
  if (repeats == 0) return absl::OkStatus();
  const int64_t begin = batch.first_sequence;
  TRUEPOSE_ASSIGN_OR_RETURN(const std::vector<Run> runs,
                            RunsOf(snapshot, batch.source, begin, begin + repeats));
  FaultList faults;
  for (const Run& run : runs) {
    const int64_t from = std::max(begin, run.first_sequence);
    const Placed placed{.first = static_cast<int>(from - begin),
                        .count = static_cast<int>(std::min(begin + repeats, run.end()) - from),
                        .first_row = run.first_row + static_cast<int>(from - run.first_sequence)};
    if (run.session == session) {
      TRUEPOSE_RETURN_IF_ERROR(
          CompareRows(snapshot, session, batch.readings, placed, "sequence", faults));
      continue;
    }
    for (int i = placed.first; i < placed.first + placed.count; ++i) {
      faults.Add(absl::StrCat("readings[", i, "].sequence"),
                 absl::StrCat(begin + i, ", which is stored in another session"),
                 "a sequence for one reading only");
    }
  }
  return faults.ToStatus(absl::StatusCode::kAborted);
}

absl::Status Extend(Transaction& transaction, const SourceBatch& batch,
                    const std::optional<Run>& last, const Run& added) {
  if (last.has_value() && last->session == added.session && last->end_row() == added.first_row) {
    return sql::Run(transaction.sql(),
                    "UPDATE reading_runs SET count = count + $3 WHERE source = $1 AND "
                    "first_sequence = $2",
                    batch.source, last->first_sequence, added.count);
  }
  return sql::Run(transaction.sql(),
                  "INSERT INTO reading_runs (source, first_sequence, session, first_row, count) "
                  "VALUES ($1, $2, $3, $4, $5)",
                  batch.source, added.first_sequence, added.session, added.first_row, added.count);
}

}  // namespace

absl::StatusOr<SourceProgress> AppendFromSource(Transaction& transaction,
                                                const SourceBatch& batch) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Key session, SessionOf(transaction, batch));
  TRUEPOSE_ASSIGN_OR_RETURN(const std::optional<Run> last, LastRun(transaction, batch.source));
  const int64_t next = last.has_value() ? last->end() : 1;
  if (batch.first_sequence < 1 || batch.first_sequence > next) {
    return Gap(batch.first_sequence, next);
  }
  const int size = batch.readings.size();
  const int repeats = static_cast<int>(std::min<int64_t>(next - batch.first_sequence, size));
  TRUEPOSE_RETURN_IF_ERROR(CheckRepeats(transaction, batch, session, repeats));
  TRUEPOSE_ASSIGN_OR_RETURN(const int stored, CountRows(transaction, session));
  if (repeats == size) return SourceProgress{stored, next - 1};
  const int added = size - repeats;
  TRUEPOSE_RETURN_IF_ERROR(
      InsertRows(transaction, session, batch.readings, {repeats, added, stored}));
  TRUEPOSE_RETURN_IF_ERROR(Extend(transaction, batch, last, {next, session, stored, added}));
  return SourceProgress{stored + added, next - 1 + added};
}

absl::Status UnknownSession(std::string_view session) {
  return Refusal(absl::StatusCode::kNotFound, "session", std::string(session),
                 "a session that is stored here; create it with its id, then send again");
}

absl::StatusOr<int64_t> DurableSequence(Snapshot& snapshot, std::string_view source) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::optional<Run> last, LastRun(snapshot, source));
  return last.has_value() ? last->end() - 1 : 0;
}

}  // namespace truepose::store
