#include "server/store/resources.h"

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "server/store/events.h"
#include "server/store/message.h"
#include "server/store/sql/query.h"

namespace truepose::store {
namespace {

constexpr char kOfAll[] =
    "SELECT sequence, message FROM resources WHERE kind = $1 AND $2 = '' AND sequence > $3 AND "
    "deleted <= $4 ORDER BY sequence";
constexpr char kOfRobot[] =
    "SELECT sequence, message FROM resources WHERE kind = $1 AND robot_id = $2 AND sequence > $3 "
    "AND deleted <= $4 ORDER BY sequence";

ListId ListIdOf(const ResourceList& list) {
  return {
      v1::ResourceKind_Name(list.kind),
      absl::StrCat(list.robot_id.value_or("*"), "|", list.show_deleted ? 1 : 0, "|", list.filter)};
}

}  // namespace

absl::Status PutResource(Transaction& transaction, const ResourceKey& key, const std::string& name,
                         const google::protobuf::Message& resource, bool deleted) {
  TRUEPOSE_RETURN_IF_ERROR(
      sql::Run(transaction.sql(),
               "INSERT INTO resources (sequence, kind, robot_id, id, deleted, message) VALUES "
               "((SELECT COALESCE(MAX(sequence), 0) + 1 FROM resources), $1, $2, $3, $4, $5) "
               "ON CONFLICT (kind, robot_id, id) DO UPDATE SET deleted = excluded.deleted, "
               "message = excluded.message",
               static_cast<int>(key.kind), key.robot_id, key.id, deleted ? 1 : 0,
               sql::BlobView{ToBlob(resource)}));
  return RecordEvent(transaction,
                     {.kind = key.kind, .robot_id = key.robot_id, .name = name, .deleted = deleted},
                     resource);
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
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto rows, sql::Query(snapshot.sql(), list.robot_id.has_value() ? kOfRobot : kOfAll,
                            static_cast<int>(list.kind), list.robot_id.value_or(""), after,
                            list.show_deleted ? 1 : 0));
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
