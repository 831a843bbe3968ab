#include "server/services/robot_events.h"

#include "server/resource/resource_name.h"
#include "server/services/closures.h"
#include "server/services/live.h"
#include "server/services/poses_to_measure.h"
#include "server/services/recalibration_causes.h"
#include "server/services/stored_resources.h"

namespace truepose::services {
namespace {

using store::Transaction;

absl::Status Raise(Transaction& transaction, const std::string& robot, const v1::RobotEvent& event,
                   const PosesToMeasure* poses) {
  TRUEPOSE_ASSIGN_OR_RETURN(const auto cause,
                            CauseOfEvent(transaction, robot, event, transaction.now()));
  if (!cause.has_value()) return absl::OkStatus();
  return RaiseOrNote(transaction, *cause, poses).status();
}

absl::StatusOr<v1::RobotEvent> Create(Transaction& transaction, const store::ResourceKey& key,
                                      const std::string& robot, const v1::RobotEvent& content,
                                      const PosesToMeasure* poses) {
  TRUEPOSE_RETURN_IF_ERROR(GetLiveRobot(transaction, robot, "parent").status());
  TRUEPOSE_ASSIGN_OR_RETURN(const auto known, store::FindResource(transaction, key));
  v1::RobotEvent event;
  TRUEPOSE_RETURN_IF_ERROR(
      resource::Create(transaction, TypeOf<v1::RobotEvent>(), key, content, "robot_event", event));
  if (!known.has_value()) TRUEPOSE_RETURN_IF_ERROR(Raise(transaction, robot, event, poses));
  return event;
}

}  // namespace

absl::StatusOr<v1::RobotEvent> CreateRobotEvent(const CallContext& call,
                                                const v1::CreateRobotEventRequest& request) {
  const resource::ResourceType& type = TypeOf<v1::RobotEvent>();
  TRUEPOSE_ASSIGN_OR_RETURN(
      const store::ResourceKey key,
      resource::MakeKey(type, request.parent(), request.robot_event_id(), "robot_event_id"));
  v1::RobotEvent content = request.robot_event();
  resource::PrepareContent(type, call.caller.principal, content);
  return WithPoses(call.store, request.parent(), [&](const PosesToMeasure* poses) {
    return WriteOnce(call, request, [&](Transaction& transaction) {
      return Create(transaction, key, request.parent(), content, poses);
    });
  });
}

}  // namespace truepose::services
