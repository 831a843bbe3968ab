#include "server/services/live.h"

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

}  // namespace truepose::services
