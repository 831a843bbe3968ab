#include "server/services/live.h"

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/robots.h"

namespace truepose::services {

absl::StatusOr<v1::Robot> GetLiveRobot(store::Snapshot& snapshot, const std::string& name,
                                       const std::string& field) {
  TRUEPOSE_RETURN_IF_ERROR(store::ParseRobotName(name, field).status());
  const absl::StatusOr<v1::Robot> robot = store::GetRobot(snapshot, name);
  if (absl::IsNotFound(robot.status()) || (robot.ok() && robot->has_delete_time()))
    return store::NotFound(name, field);
  return robot;
}

absl::Status CheckEtag(const std::string& stored, const std::string& asked) {
  if (asked.empty() || asked == stored) return absl::OkStatus();
  return store::Refusal(absl::StatusCode::kAborted, "etag", asked,
                        absl::StrCat(stored, ": it was changed meanwhile; get it again"));
}

}  // namespace truepose::services
