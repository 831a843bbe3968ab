#include "server/store/resources.h"

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "server/store/events.h"
#include "server/store/message.h"
#include "server/store/sql/query.h"

namespace truepose::store {
namespace {

// Of all queries $2 is the robot, "" = of all robots and of the plant.
constexpr char kOfAll[] =
    "SELECT sequence, message FROM resources WHERE kind = $1 AND $2 = '' AND sequence > $3 AND "
    "deleted <= $4 ORDER BY sequence";
constexpr char kOfRobot[] =
    "SELECT sequence, message FROM resources WHERE kind = $1 AND robot_id = $2 AND sequence > $3 "
    "AND deleted <= $4 ORDER BY sequence";
constexpr char kOpen[] =
    "SELECT sequence, message FROM resources WHERE kind = $1 AND open = 1 AND ($2 = '' OR robot_id "
    "= $2) AND sequence > $3 AND deleted <= $4 ORDER BY sequence";
constexpr char kOfFile[] =
    "SELECT sequence, message FROM table_files JOIN resources ON sequence = resource WHERE sha256 "
    "= "
    "$5 AND kind = $1 AND ($2 = '' OR robot_id = $2) AND sequence > $3 AND deleted <= $4 ORDER BY "
    "sequence";

ListId ListIdOf(const ResourceList& list) {
  return {
      v1::ResourceKind_Name(list.kind),
      absl::StrCat(list.robot_id.value_or("*"), "|", list.show_deleted ? 1 : 0, "|", list.filter)};
}

absl::StatusOr<std::unique_ptr<sql::Statement>> RowsOf(Snapshot& snapshot, const ResourceList& list,
                                                       int64_t after) {
  const int kind = static_cast<int>(list.kind), deleted = list.show_deleted ? 1 : 0;
  const std::string robot = list.robot_id.value_or("");
  if (!list.sha256.empty())
    return sql::Query(snapshot.sql(), kOfFile, kind, robot, after, deleted, list.sha256);
  const char* const query =
      list.only_open ? kOpen : (list.robot_id.has_value() ? kOfRobot : kOfAll);
  return sql::Query(snapshot.sql(), query, kind, robot, after, deleted);
}

}  // namespace

absl::Status PutResource(Transaction& transaction, const ResourceKey& key, const std::string& name,
                         const google::protobuf::Message& resource, bool deleted, bool open) {
  TRUEPOSE_RETURN_IF_ERROR(sql::Run(
      transaction.sql(),
      "INSERT INTO resources (sequence, kind, robot_id, id, deleted, message, open) VALUES "
      "((SELECT COALESCE(MAX(sequence), 0) + 1 FROM resources), $1, $2, $3, $4, $5, $6) "
      "ON CONFLICT (kind, robot_id, id) DO UPDATE SET deleted = excluded.deleted, "
      "message = excluded.message, open = excluded.open",
      static_cast<int>(key.kind), key.robot_id, key.id, deleted ? 1 : 0,
      sql::BlobView{ToBlob(resource)}, open ? 1 : 0));
  return RecordEvent(transaction,
                     {.kind = key.kind, .robot_id = key.robot_id, .name = name, .deleted = deleted},
                     resource);
}

absl::Status CloseResource(Transaction& transaction, const ResourceKey& key) {
  return sql::Run(transaction.sql(),
                  "UPDATE resources SET open = 0 WHERE kind = $1 AND robot_id = $2 AND id = $3",
                  static_cast<int>(key.kind), key.robot_id, key.id);
}

absl::StatusOr<std::optional<std::string>> FindResource(Snapshot& snapshot,
                                                        const ResourceKey& key) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto row, sql::Query(snapshot.sql(),
                           "SELECT message FROM resources WHERE kind = $1 AND robot_id = $2 AND "
                           "id = $3",
                           static_cast<int>(key.kind), key.robot_id, key.id));
  TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
  return found ? std::optional(row->Blob(0)) : std::nullopt;
}

absl::StatusOr<std::string> ListResources(
    Snapshot& snapshot, const ResourceList& list, const PageRequest& request,
    const std::function<absl::StatusOr<bool>(const std::string&)>& visit) {
  const ListId id = ListIdOf(list);
  TRUEPOSE_ASSIGN_OR_RETURN(const PageStart start, CheckPage(id, request));
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t after, AfterNumber(start, 0));
  TRUEPOSE_ASSIGN_OR_RETURN(auto rows, RowsOf(snapshot, list, after));
  std::string last;
  for (int taken = 0;;) {
    TRUEPOSE_ASSIGN_OR_RETURN(const bool found, rows->Step());
    if (!found) return std::string();
    if (taken == start.size) return MakePageToken(id, last);
    TRUEPOSE_ASSIGN_OR_RETURN(const bool belongs, visit(rows->Blob(1)));
    last = rows->Text(0);
    taken += belongs ? 1 : 0;
  }
}

}  // namespace truepose::store
