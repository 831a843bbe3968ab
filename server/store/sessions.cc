#include "server/store/sessions.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/store/keys.h"
#include "server/store/list.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/robots.h"
#include "server/store/session_row.h"
#include "server/store/sql/query.h"

namespace truepose::store {
namespace {

// What a client gives when it creates a session, but for the nominal revision.
v1::Session Given(const v1::Session& from) {
  v1::Session given;
  given.set_robot(from.robot());
  given.set_source(from.source());
  *given.mutable_extra_columns() = from.extra_columns();
  CopySessionSettings(from, given);
  return given;
}

// What a repeated create has to agree in. An empty revision meant "the latest" and agrees with any.
bool IsSameRequest(const v1::Session& stored, const v1::Session& asked) {
  const bool same_nominal =
      asked.nominal_revision().empty() || stored.nominal_revision() == asked.nominal_revision();
  return same_nominal && !stored.has_delete_time() && ToBlob(Given(stored)) == ToBlob(Given(asked));
}

// The revision that the session is measured for, of its own robot.
absl::StatusOr<std::string> ChooseNominal(Snapshot& snapshot, const v1::Session& session) {
  const absl::StatusOr<v1::Robot> robot = GetRobot(snapshot, session.robot());
  if (!robot.ok()) return AtField(robot.status(), "session.robot");
  if (session.nominal_revision().empty()) return robot->nominal_revision().name();
  const absl::Status known = GetNominalRevision(snapshot, session.nominal_revision()).status();
  if (!known.ok()) return AtField(known, "session.nominal_revision");
  TRUEPOSE_ASSIGN_OR_RETURN(const NumberedName name, ParseNominalName(session.nominal_revision()));
  if (RobotName(name.robot_id) == session.robot()) return session.nominal_revision();
  return FaultStatus("session.nominal_revision", session.nominal_revision(),
                     absl::StrCat("a revision of ", session.robot()));
}

absl::Status InsertSession(Transaction& transaction, const std::string& id,
                           const v1::Session& asked) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string nominal, ChooseNominal(transaction, asked));
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string robot_id, ParseRobotName(asked.robot()));
  v1::Session session = Given(asked);
  session.set_name(SessionName(id));
  session.set_nominal_revision(nominal);
  session.set_created_by(asked.created_by());
  session.set_state(v1::OPEN);
  *session.mutable_create_time() = ToTimestamp(transaction.now());
  TRUEPOSE_RETURN_IF_ERROR(
      sql::Run(transaction.sql(),
               "INSERT INTO sessions (sequence, id, robot_id, message) VALUES "
               "((SELECT COALESCE(MAX(sequence), 0) + 1 FROM sessions), $1, $2, $3)",
               id, robot_id, sql::BlobView{}));
  return UpdateSession(transaction, session);
}

absl::Status SealFault(std::string field, std::string found, std::string expected) {
  return Refusal(absl::StatusCode::kFailedPrecondition, std::move(field), std::move(found),
                 std::move(expected));
}

absl::Status CheckSeal(const v1::Session& session, int reading_count, std::string_view digest) {
  if (session.reading_count() != reading_count) {
    return SealFault("reading_count", absl::StrCat(reading_count),
                     absl::StrCat(session.reading_count(), ", the readings that are stored"));
  }
  if (reading_count == 0) return SealFault("reading_count", "0", "at least one reading");
  if (session.state() == v1::SEALED && session.digest() != digest) {
    return SealFault("name", absl::StrCat(session.name(), " sealed with digest ", session.digest()),
                     absl::StrCat("digest ", std::string(digest)));
  }
  return absl::OkStatus();
}

}  // namespace

void CopySessionSettings(const v1::Session& from, v1::Session& session) {
  session.set_display_name(from.display_name());
  session.set_purpose(from.purpose());
  session.set_instrument(from.instrument());
  session.set_fixture(from.fixture());
  session.set_operator_(from.operator_());
  session.set_joint_source(from.joint_source());
  session.set_placement(from.placement());
  session.clear_temperature_c();
  session.clear_load_kg();
  if (from.has_temperature_c()) session.set_temperature_c(from.temperature_c());
  if (from.has_load_kg()) session.set_load_kg(from.load_kg());
}

absl::StatusOr<v1::Session> PutSession(Transaction& transaction, v1::Session session) {
  TRUEPOSE_RETURN_IF_ERROR(UpdateSession(transaction, session));
  return session;
}

absl::StatusOr<v1::Session> CreateSession(Transaction& transaction, std::string_view session_id,
                                          const v1::Session& session) {
  TRUEPOSE_RETURN_IF_ERROR(CheckUuid(session_id, "session_id"));
  const std::string id(session_id);
  absl::StatusOr<v1::Session> stored = GetSession(transaction, SessionName(id));
  if (stored.ok() && IsSameRequest(*stored, session)) return stored;
  if (stored.ok()) {
    return Refusal(absl::StatusCode::kAlreadyExists, "session_id",
                   absl::StrCat(stored->name(), " with other values"), "a new UUID");
  }
  if (!absl::IsNotFound(stored.status())) return stored.status();
  TRUEPOSE_RETURN_IF_ERROR(InsertSession(transaction, id, session));
  return GetSession(transaction, SessionName(id));
}

absl::StatusOr<v1::Session> GetSession(Snapshot& snapshot, std::string_view name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Key key, SessionKey(snapshot, name));
  return ReadSession(snapshot, key);
}

absl::StatusOr<Page<v1::Session>> ListSessions(Snapshot& snapshot, std::string_view robot,
                                               const PageRequest& request,
                                               const ListFilter<v1::Session>& filter) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string robot_id, RobotFilter(snapshot, robot));
  const ListId id{"sessions", absl::StrCat(robot_id, "|", filter.Key())};
  TRUEPOSE_ASSIGN_OR_RETURN(const PageStart start, CheckPage(id, request));
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t before,
                            AfterNumber(start, std::numeric_limits<int64_t>::max()));
  const char* sql =
      robot_id.empty()
          ? "SELECT sequence, message FROM sessions WHERE $1 = '' AND sequence < $2 AND "
            "deleted <= $3 ORDER BY sequence DESC"
          : "SELECT sequence, message FROM sessions WHERE robot_id = $1 AND sequence < $2 AND "
            "deleted <= $3 ORDER BY sequence DESC";
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto rows, sql::Query(snapshot.sql(), sql, robot_id, before, filter.show_deleted ? 1 : 0));
  return ReadFilteredPage<v1::Session>(
      id, start.size, *rows, filter, [&](const sql::Statement& row) -> absl::StatusOr<v1::Session> {
        TRUEPOSE_ASSIGN_OR_RETURN(v1::Session session, ReadMessage<v1::Session>(row, 1));
        TRUEPOSE_RETURN_IF_ERROR(Complete(snapshot, row.Int64(0), session));
        return session;
      });
}

absl::StatusOr<v1::Session> SealSession(Transaction& transaction, std::string_view name,
                                        int reading_count, std::string_view digest,
                                        const Sealing& sealing) {
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Session session, GetSession(transaction, name));
  TRUEPOSE_RETURN_IF_ERROR(CheckSeal(session, reading_count, digest));
  if (session.state() == v1::SEALED) return session;
  session.set_state(v1::SEALED);
  session.set_digest(std::string(digest));
  session.set_sealed_by(sealing.principal);
  if (sealing.certificate_expired)
    *session.mutable_certificate_expired_time() = *sealing.certificate_expired;
  *session.mutable_seal_time() = ToTimestamp(transaction.now());
  TRUEPOSE_RETURN_IF_ERROR(UpdateSession(transaction, session));
  return session;
}

}  // namespace truepose::store
