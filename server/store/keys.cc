#include "server/store/keys.h"

#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/robots.h"
#include "server/store/sql/query.h"

namespace truepose::store {
namespace {

absl::StatusOr<Key> FindKey(Snapshot& snapshot, std::string_view sql, const std::string& id,
                            std::string_view name, std::string_view field) {
  TRUEPOSE_ASSIGN_OR_RETURN(auto row, sql::Query(snapshot.sql(), sql, id));
  TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
  if (!found) return NotFound(name, field);
  return row->Int64(0);
}

}  // namespace

absl::StatusOr<Key> SessionKey(Snapshot& snapshot, std::string_view name, std::string_view field) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string id, ParseSessionName(name, field));
  return FindKey(snapshot, "SELECT sequence FROM sessions WHERE id = $1", id, name, field);
}

absl::StatusOr<Key> JobKey(Snapshot& snapshot, std::string_view name, std::string_view field) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string id, ParseJobName(name, field));
  return FindKey(snapshot, "SELECT sequence FROM jobs WHERE id = $1", id, name, field);
}

absl::StatusOr<std::string> RobotFilter(Snapshot& snapshot, std::string_view robot) {
  if (robot.empty()) return std::string();
  const absl::Status known = GetRobot(snapshot, robot).status();
  if (!known.ok()) return AtField(known, "robot");
  return ParseRobotName(robot, "robot");
}

absl::Status AtField(const absl::Status& status, std::string_view field) {
  FaultList faults;
  for (Fault fault : FaultsOf(status)) {
    if (fault.field == "name") fault.field = std::string(field);
    faults.Add(std::move(fault));
  }
  return faults.empty() ? status : faults.ToStatus(status.code());
}

}  // namespace truepose::store
