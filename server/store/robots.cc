#include "server/store/robots.h"

#include <limits>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "server/store/checksum.h"
#include "server/store/events.h"
#include "server/store/list.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/sql/query.h"

namespace truepose::store {
namespace {

// The latest revision of a robot, which always has one.
constexpr char kLatest[] =
    "SELECT message FROM nominals WHERE robot_id = $1 ORDER BY number DESC LIMIT 1";

absl::StatusOr<v1::NominalRevision> ReadLatest(Snapshot& snapshot, const std::string& robot_id) {
  TRUEPOSE_ASSIGN_OR_RETURN(auto row, sql::Query(snapshot.sql(), kLatest, robot_id));
  TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
  if (!found) return NotFound(RobotName(robot_id));
  return ReadMessage<v1::NominalRevision>(*row, 0);
}

absl::StatusOr<v1::Robot> Complete(Snapshot& snapshot, const std::string& robot_id,
                                   v1::Robot robot) {
  TRUEPOSE_ASSIGN_OR_RETURN(*robot.mutable_nominal_revision(), ReadLatest(snapshot, robot_id));
  return robot;
}

absl::StatusOr<v1::NominalRevision> InsertNominal(Transaction& transaction,
                                                  const std::string& robot_id, int64_t number,
                                                  const v1::Nominal& nominal,
                                                  std::string_view digest) {
  v1::NominalRevision revision;
  revision.set_name(NominalName(robot_id, number));
  *revision.mutable_nominal() = nominal;
  revision.set_digest(std::string(digest));
  *revision.mutable_create_time() = ToTimestamp(transaction.now());
  TRUEPOSE_RETURN_IF_ERROR(
      sql::Run(transaction.sql(),
               "INSERT INTO nominals (robot_id, number, digest, message) VALUES ($1, $2, $3, $4)",
               robot_id, number, digest, sql::BlobView{ToBlob(revision)}));
  return revision;
}

// The robot's own state, without the nominal, which stands in its own table.
absl::Status StampRobot(Transaction& transaction, const std::string& robot_id, v1::Robot robot) {
  robot.clear_nominal_revision();
  *robot.mutable_update_time() = ToTimestamp(transaction.now());
  robot.set_revision(transaction.revision());
  robot.set_etag(ToEtag(transaction.revision()));
  return sql::Run(transaction.sql(),
                  "INSERT INTO robots (id, deleted, message) VALUES ($1, $2, $3) ON CONFLICT (id) "
                  "DO UPDATE SET deleted = excluded.deleted, message = excluded.message",
                  robot_id, robot.has_delete_time() ? 1 : 0, sql::BlobView{ToBlob(robot)});
}

// Once state and nominal are both stored.
absl::StatusOr<v1::Robot> RecordRobot(Transaction& transaction, const std::string& robot_id) {
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Robot robot, GetRobot(transaction, RobotName(robot_id)));
  TRUEPOSE_RETURN_IF_ERROR(RecordEvent(transaction,
                                       {.kind = v1::KIND_ROBOT,
                                        .robot_id = robot_id,
                                        .name = robot.name(),
                                        .deleted = robot.has_delete_time()},
                                       robot));
  return robot;
}

absl::Status InsertRobot(Transaction& transaction, const std::string& robot_id,
                         const v1::Robot& settings, const v1::Nominal& nominal,
                         std::string_view digest) {
  v1::Robot robot;
  robot.set_name(RobotName(robot_id));
  robot.set_uid(NewUuid());
  CopyRobotSettings(settings, robot);
  *robot.mutable_create_time() = ToTimestamp(transaction.now());
  TRUEPOSE_RETURN_IF_ERROR(StampRobot(transaction, robot_id, robot));
  return InsertNominal(transaction, robot_id, 1, nominal, digest).status();
}

absl::Status CheckSameContent(Transaction& transaction, const v1::Robot& robot,
                              const std::string& robot_id, std::string_view digest) {
  const bool deleted = robot.has_delete_time();
  if (robot.nominal_revision().digest() == digest && !deleted) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::NominalRevision first,
                            GetNominalRevision(transaction, NominalName(robot_id, 1)));
  if (first.digest() == digest && !deleted) return absl::OkStatus();
  return Refusal(
      absl::StatusCode::kAlreadyExists, "robot_id",
      absl::StrCat(robot.name(), deleted ? ", which is deleted" : " with other content"),
      deleted ? "a new id, or undelete" : "a new id, or a nominal revision of that robot");
}

}  // namespace

void CopyRobotSettings(const v1::Robot& from, v1::Robot& robot) {
  robot.set_display_name(from.display_name());
  robot.set_release_policy(from.release_policy());
  robot.clear_limits();
  if (from.has_limits()) *robot.mutable_limits() = from.limits();
  robot.clear_table_spec();
  if (from.has_table_spec()) *robot.mutable_table_spec() = from.table_spec();
}

absl::StatusOr<v1::Robot> CreateRobot(Transaction& transaction, std::string_view robot_id,
                                      const v1::Nominal& nominal, std::string_view digest,
                                      const v1::Robot& settings) {
  TRUEPOSE_RETURN_IF_ERROR(CheckRobotId(robot_id, "robot_id"));
  const std::string id(robot_id);
  const absl::StatusOr<v1::Robot> stored = GetRobot(transaction, RobotName(id));
  if (stored.ok()) {
    TRUEPOSE_RETURN_IF_ERROR(CheckSameContent(transaction, *stored, id, digest));
    return stored;
  }
  if (!absl::IsNotFound(stored.status())) return stored.status();
  TRUEPOSE_RETURN_IF_ERROR(InsertRobot(transaction, id, settings, nominal, digest));
  return RecordRobot(transaction, id);
}

absl::StatusOr<v1::Robot> PutRobot(Transaction& transaction, const v1::Robot& robot) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string id, ParseRobotName(robot.name(), "robot.name"));
  TRUEPOSE_RETURN_IF_ERROR(StampRobot(transaction, id, robot));
  return RecordRobot(transaction, id);
}

absl::StatusOr<v1::NominalRevision> AddNominalRevision(Transaction& transaction,
                                                       std::string_view robot_name,
                                                       const v1::Nominal& nominal,
                                                       std::string_view digest) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot, GetRobot(transaction, robot_name));
  const v1::NominalRevision& latest = robot.nominal_revision();
  if (latest.digest() == digest) return latest;
  TRUEPOSE_ASSIGN_OR_RETURN(const NumberedName name, ParseNominalName(latest.name()));
  TRUEPOSE_RETURN_IF_ERROR(StampRobot(transaction, name.robot_id, robot));
  TRUEPOSE_ASSIGN_OR_RETURN(
      v1::NominalRevision revision,
      InsertNominal(transaction, name.robot_id, name.number + 1, nominal, digest));
  TRUEPOSE_RETURN_IF_ERROR(RecordRobot(transaction, name.robot_id).status());
  return revision;
}

absl::StatusOr<v1::Robot> GetRobot(Snapshot& snapshot, std::string_view name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string id, ParseRobotName(name));
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto row, sql::Query(snapshot.sql(), "SELECT message FROM robots WHERE id = $1", id));
  TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
  if (!found) return NotFound(name);
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Robot robot, ReadMessage<v1::Robot>(*row, 0));
  return Complete(snapshot, id, std::move(robot));
}

absl::StatusOr<v1::NominalRevision> GetNominalRevision(Snapshot& snapshot, std::string_view name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const NumberedName key, ParseNominalName(name));
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto row,
      sql::Query(snapshot.sql(), "SELECT message FROM nominals WHERE robot_id = $1 AND number = $2",
                 key.robot_id, key.number));
  TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
  if (!found) return NotFound(name);
  return ReadMessage<v1::NominalRevision>(*row, 0);
}

absl::StatusOr<Page<v1::Robot>> ListRobots(Snapshot& snapshot, const PageRequest& request,
                                           const ListFilter<v1::Robot>& filter) {
  const ListId id{"robots", filter.Key()};
  TRUEPOSE_ASSIGN_OR_RETURN(const PageStart start, CheckPage(id, request));
  TRUEPOSE_ASSIGN_OR_RETURN(auto rows,
                            sql::Query(snapshot.sql(),
                                       "SELECT id, message FROM robots WHERE id > $1 AND "
                                       "deleted <= $2 ORDER BY id",
                                       start.after, filter.show_deleted ? 1 : 0));
  return ReadFilteredPage<v1::Robot>(
      id, start.size, *rows, filter, [&](const sql::Statement& row) -> absl::StatusOr<v1::Robot> {
        TRUEPOSE_ASSIGN_OR_RETURN(v1::Robot robot, ReadMessage<v1::Robot>(row, 1));
        return Complete(snapshot, row.Text(0), std::move(robot));
      });
}

absl::StatusOr<Page<v1::NominalRevision>> ListNominalRevisions(Snapshot& snapshot,
                                                               std::string_view robot_name,
                                                               const PageRequest& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot, GetRobot(snapshot, robot_name));
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string robot_id, ParseRobotName(robot_name));
  const ListId id{"nominals", robot_id};
  TRUEPOSE_ASSIGN_OR_RETURN(const PageStart start, CheckPage(id, request));
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t before,
                            AfterNumber(start, std::numeric_limits<int64_t>::max()));
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto rows,
      sql::Query(snapshot.sql(),
                 "SELECT number, message FROM nominals WHERE robot_id = $1 AND number < $2 "
                 "ORDER BY number DESC LIMIT $3",
                 robot_id, before, start.size + 1));
  return ReadPage<v1::NominalRevision>(id, start.size, *rows, [](const sql::Statement& row) {
    return ReadMessage<v1::NominalRevision>(row, 1);
  });
}

}  // namespace truepose::store
