#include "server/store/session_row.h"

#include "core/base/status_macros.h"
#include "server/store/events.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/reading_rows.h"
#include "server/store/sql/query.h"

namespace truepose::store {

absl::StatusOr<v1::Session> ReadSession(Snapshot& snapshot, Key key) {
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Session session, ReadSessionMessage(snapshot, key));
  TRUEPOSE_RETURN_IF_ERROR(Complete(snapshot, key, session));
  return session;
}

absl::Status Complete(Snapshot& snapshot, Key key, v1::Session& session) {
  if (session.state() != v1::OPEN) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(const int count, CountRows(snapshot, key));
  session.set_reading_count(count);
  return absl::OkStatus();
}

absl::StatusOr<v1::Session> ReadSessionMessage(Snapshot& snapshot, Key key) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto row,
      sql::Query(snapshot.sql(), "SELECT message FROM sessions WHERE sequence = $1", key));
  TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
  if (!found) return absl::DataLossError("a session's row is missing");
  return ReadMessage<v1::Session>(*row, 0);
}

absl::Status UpdateSession(Transaction& transaction, v1::Session& session) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Key key, SessionKey(transaction, session.name()));
  session.set_revision(transaction.revision());
  session.set_etag(ToEtag(transaction.revision()));
  *session.mutable_update_time() = ToTimestamp(transaction.now());
  const bool deleted = session.has_delete_time();
  TRUEPOSE_RETURN_IF_ERROR(sql::Run(
      transaction.sql(), "UPDATE sessions SET deleted = $2, message = $3 WHERE sequence = $1", key,
      deleted ? 1 : 0, sql::BlobView{ToBlob(session)}));
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string robot_id, ParseRobotName(session.robot()));
  return RecordEvent(
      transaction,
      {.kind = v1::KIND_SESSION, .robot_id = robot_id, .name = session.name(), .deleted = deleted},
      session);
}

}  // namespace truepose::store
