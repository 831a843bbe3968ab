#include "server/store/robots.h"

#include <limits>
#include <memory>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
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
  robot.set_revision(transaction.revision());
  robot.set_etag(ToEtag(transaction.revision()));
  return sql::Run(transaction.sql(),
                  "INSERT INTO robots (id, message) VALUES ($1, $2) "
                  "ON CONFLICT (id) DO UPDATE SET message = excluded.message",
                  robot_id, sql::BlobView{ToBlob(robot)});
}

absl::Status InsertRobot(Transaction& transaction, const std::string& robot_id,
                         const v1::Nominal& nominal, std::string_view digest) {
  v1::Robot robot;
  robot.set_name(RobotName(robot_id));
  *robot.mutable_create_time() = ToTimestamp(transaction.now());
  TRUEPOSE_RETURN_IF_ERROR(StampRobot(transaction, robot_id, robot));
  return InsertNominal(transaction, robot_id, 1, nominal, digest).status();
}

absl::Status CheckSameContent(Transaction& transaction, const v1::Robot& robot,
                              const std::string& robot_id, std::string_view digest) {
  if (robot.nominal_revision().digest() == digest) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::NominalRevision first,
                            GetNominalRevision(transaction, NominalName(robot_id, 1)));
  if (first.digest() == digest) return absl::OkStatus();
  return Refusal(absl::StatusCode::kAlreadyExists, "robot_id",
                 absl::StrCat(robot.name(), " with other content"),
                 "a new id, or a nominal revision of that robot");
}

}  // namespace

absl::StatusOr<v1::Robot> CreateRobot(Transaction& transaction, std::string_view robot_id,
                                      const v1::Nominal& nominal, std::string_view digest) {
  TRUEPOSE_RETURN_IF_ERROR(CheckRobotId(robot_id, "robot_id"));
  const std::string id(robot_id);
  const absl::StatusOr<v1::Robot> stored = GetRobot(transaction, RobotName(id));
  if (stored.ok()) {
    TRUEPOSE_RETURN_IF_ERROR(CheckSameContent(transaction, *stored, id, digest));
    return stored;
  }
  if (!absl::IsNotFound(stored.status())) return stored.status();
  TRUEPOSE_RETURN_IF_ERROR(InsertRobot(transaction, id, nominal, digest));
  return GetRobot(transaction, RobotName(id));
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
  return InsertNominal(transaction, name.robot_id, name.number + 1, nominal, digest);
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

absl::StatusOr<Page<v1::Robot>> ListRobots(Snapshot& snapshot, const PageRequest& request) {
  const ListId id{"robots", ""};
  TRUEPOSE_ASSIGN_OR_RETURN(const PageStart start, CheckPage(id, request));
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto rows, sql::Query(snapshot.sql(),
                            "SELECT id, message FROM robots WHERE id > $1 ORDER BY id LIMIT $2",
                            start.after, start.size + 1));
  return ReadPage<v1::Robot>(
      id, start.size, *rows, [&](const sql::Statement& row) -> absl::StatusOr<v1::Robot> {
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
