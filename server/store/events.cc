#include "server/store/events.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "google/protobuf/descriptor.h"
#include "server/store/message.h"
#include "server/store/sql/query.h"

namespace truepose::store {
namespace {

absl::StatusOr<int64_t> CompactedRevision(Snapshot& snapshot) {
  return sql::QueryInt64(snapshot.sql(), "SELECT compacted_revision FROM store WHERE id = 1");
}

absl::Status CheckInHistory(Snapshot& snapshot, int64_t after, int64_t last) {
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t compacted, CompactedRevision(snapshot));
  if (after >= compacted && after <= last) return absl::OkStatus();
  return Refusal(absl::StatusCode::kOutOfRange, "after_revision", absl::StrCat(after),
                 absl::StrCat(compacted, " to ", last,
                              ", what the history holds; begin with a new snapshot (0)"));
}

bool Matches(const EventFilter& filter, const sql::Statement& row) {
  const auto kind = static_cast<v1::ResourceKind>(row.Int64(1));
  return (filter.robot_id.empty() || filter.robot_id == row.Text(2)) &&
         (filter.kinds.empty() || filter.kinds.contains(kind)) &&
         (filter.name.empty() || filter.name == row.Text(3));
}

absl::StatusOr<v1::WatchEvent> ReadEvent(const sql::Statement& row) {
  return ToWatchEvent(row.Int64(0),
                      {.kind = static_cast<v1::ResourceKind>(row.Int64(1)),
                       .robot_id = row.Text(2),
                       .name = row.Text(3),
                       .deleted = row.Int64(4) != 0},
                      row.Blob(5));
}

// The member of the oneof that holds this kind: both are in the order of ResourceKind.
const google::protobuf::FieldDescriptor* FieldOf(v1::ResourceKind kind) {
  const auto* resources = v1::WatchEvent::descriptor()->FindOneofByName("resource");
  const int index = static_cast<int>(kind) - 1;
  return index >= 0 && index < resources->field_count() ? resources->field(index) : nullptr;
}

// Commits that are over the history: a revision, everything up to it may go.
absl::StatusOr<int64_t> LastToForget(Transaction& transaction, const EventHistory& history) {
  const int64_t oldest = absl::ToUnixMicros(transaction.now() - history.age);
  TRUEPOSE_ASSIGN_OR_RETURN(
      const int64_t by_age,
      sql::QueryInt64(transaction.sql(),
                      "SELECT COALESCE(MAX(revision), 0) FROM events WHERE written_us < $1",
                      oldest));
  TRUEPOSE_ASSIGN_OR_RETURN(
      const int64_t by_count,
      sql::QueryInt64(transaction.sql(),
                      "SELECT COALESCE((SELECT revision FROM events ORDER BY revision DESC, "
                      "ordinal DESC LIMIT 1 OFFSET $1), 0)",
                      history.count));
  return std::max(by_age, by_count);
}

// The last revision of which at most `most` events lie before its end; at least the first commit.
absl::StatusOr<int64_t> BoundByNumber(Transaction& transaction, int64_t last, int64_t most) {
  return sql::QueryInt64(transaction.sql(),
                         "SELECT MIN($1, COALESCE((SELECT revision FROM events ORDER BY revision, "
                         "ordinal LIMIT 1 OFFSET $2), $1))",
                         last, most - 1);
}

}  // namespace

absl::Status RecordEvent(Transaction& transaction, const ChangedResource& changed,
                         const google::protobuf::MessageLite& resource) {
  return sql::Run(
      transaction.sql(),
      "INSERT INTO events (revision, ordinal, written_us, kind, robot_id, name, deleted, message) "
      "VALUES ($1, (SELECT COALESCE(MAX(ordinal), -1) + 1 FROM events WHERE revision = $1), $2, "
      "$3, $4, $5, $6, $7)",
      transaction.revision(), absl::ToUnixMicros(transaction.now()), static_cast<int>(changed.kind),
      changed.robot_id, changed.name, changed.deleted ? 1 : 0, sql::BlobView{ToBlob(resource)});
}

absl::StatusOr<v1::WatchEvent> ToWatchEvent(int64_t revision, const ChangedResource& changed,
                                            const std::string& message) {
  v1::WatchEvent event;
  event.set_revision(revision);
  event.set_kind(changed.kind);
  event.set_name(changed.name);
  event.set_deleted(changed.deleted);
  const auto* field = FieldOf(changed.kind);
  if (field == nullptr ||
      !event.GetReflection()->MutableMessage(&event, field)->ParseFromString(message)) {
    return absl::DataLossError(absl::StrCat("the event of ", changed.name, " can't be read"));
  }
  return event;
}

absl::StatusOr<EventBatch> EventsAfter(Snapshot& snapshot, int64_t after, const EventFilter& filter,
                                       int most_events, int64_t most_bytes) {
  EventBatch batch;
  TRUEPOSE_ASSIGN_OR_RETURN(
      const int64_t last,
      sql::QueryInt64(snapshot.sql(), "SELECT revision FROM store WHERE id = 1"));
  TRUEPOSE_RETURN_IF_ERROR(CheckInHistory(snapshot, after, last));
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto rows, sql::Query(snapshot.sql(),
                            "SELECT revision, kind, robot_id, name, deleted, message FROM events "
                            "WHERE revision > $1 ORDER BY revision, ordinal",
                            after));
  int64_t bytes = 0;
  for (int64_t told = after;;) {
    TRUEPOSE_ASSIGN_OR_RETURN(const bool found, rows->Step());
    if (!found) break;
    const int64_t revision = rows->Int64(0);
    const bool full = static_cast<int>(batch.events.size()) >= most_events || bytes >= most_bytes;
    if (revision != told && full) {
      batch.revision = told;
      batch.has_more = true;
      return batch;
    }
    told = revision;
    if (!Matches(filter, *rows)) continue;
    TRUEPOSE_ASSIGN_OR_RETURN(v1::WatchEvent event, ReadEvent(*rows));
    bytes += static_cast<int64_t>(event.ByteSizeLong());
    batch.events.push_back(std::move(event));
  }
  batch.revision = last;
  return batch;
}

absl::StatusOr<bool> HasEventsToForget(Snapshot& snapshot, const EventHistory& history,
                                       absl::Time now) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      const int64_t count,
      sql::QueryInt64(snapshot.sql(),
                      "SELECT (SELECT COUNT(*) FROM (SELECT 1 FROM events WHERE written_us < $1 "
                      "LIMIT 1) AS old) + (SELECT COUNT(*) FROM (SELECT 1 FROM events LIMIT 1 "
                      "OFFSET $2) AS many)",
                      absl::ToUnixMicros(now - history.age), history.count));
  return count > 0;
}

absl::StatusOr<int64_t> ForgetEvents(Transaction& transaction, const EventHistory& history,
                                     int64_t most) {
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t last, LastToForget(transaction, history));
  if (last == 0) return 0;
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t bound, BoundByNumber(transaction, last, most));
  TRUEPOSE_ASSIGN_OR_RETURN(
      const int64_t count,
      sql::QueryInt64(transaction.sql(), "SELECT COUNT(*) FROM events WHERE revision <= $1",
                      bound));
  TRUEPOSE_RETURN_IF_ERROR(
      sql::Run(transaction.sql(), "DELETE FROM events WHERE revision <= $1", bound));
  TRUEPOSE_RETURN_IF_ERROR(sql::Run(
      transaction.sql(),
      "UPDATE store SET compacted_revision = MAX(compacted_revision, $1) WHERE id = 1", bound));
  return count;
}

}  // namespace truepose::store
