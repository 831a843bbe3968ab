#include "server/resource/stored_checks.h"

#include <string>

#include "absl/strings/str_cat.h"
#include "absl/time/time.h"
#include "core/base/status_macros.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/robots.h"
#include "truepose/v1/plant.pb.h"
#include "truepose/v1/recalibration.pb.h"

namespace truepose::resource {
namespace {

using store::ResourceKey;
using store::Transaction;

constexpr absl::Duration kClocksDiffer = absl::Minutes(5);

absl::Status CheckJoint(Transaction& transaction, const ResourceKey& key, int joint,
                        FaultList& faults) {
  if (joint <= 0) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot,
                            store::GetRobot(transaction, store::RobotName(key.robot_id)));
  const int joints = robot.nominal_revision().nominal().joints_size();
  if (joint > joints)
    faults.Add("joint", absl::StrCat(joint), absl::StrCat("1 to ", joints, ", 0 unknown"));
  return absl::OkStatus();
}

}  // namespace

absl::Status CheckRobotEventWithin(Transaction& transaction, const ResourceKey& key,
                                   const google::protobuf::Message& content, FaultList& faults) {
  const auto& event = static_cast<const v1::RobotEvent&>(content);
  const absl::Time time = store::ToTime(event.event_time());
  if (event.has_event_time() && time > transaction.now() + kClocksDiffer) {
    faults.Add("event_time", absl::FormatTime(time, absl::UTCTimeZone()),
               absl::StrCat("a time that has passed; here it is ",
                            absl::FormatTime(transaction.now(), absl::UTCTimeZone())));
  }
  return CheckJoint(transaction, key, event.joint(), faults);
}

absl::Status CheckPolicyWithin(Transaction& transaction, const ResourceKey& key,
                               const google::protobuf::Message& content, FaultList& faults) {
  const auto& policy = static_cast<const v1::RecalibrationPolicy&>(content);
  if (policy.pose_set().empty()) return absl::OkStatus();
  v1::RecalibrationPolicy before;
  TRUEPOSE_ASSIGN_OR_RETURN(const auto known, store::FindResource(transaction, key));
  const bool is_update = known.has_value() && before.ParseFromString(*known);
  if (is_update && before.pose_set() == policy.pose_set()) return absl::OkStatus();
  const std::string prefix = absl::StrCat(store::RobotName(key.robot_id), "/poseSets/");
  ResourceKey of_set{v1::KIND_POSE_SET, key.robot_id, ""};
  if (policy.pose_set().starts_with(prefix)) of_set.id = policy.pose_set().substr(prefix.size());
  TRUEPOSE_ASSIGN_OR_RETURN(const auto stored, store::FindResource(transaction, of_set));
  v1::PoseSet set;
  const bool is_there = stored.has_value() && set.ParseFromString(*stored);
  if (!is_there || set.has_delete_time())
    faults.Add("pose_set", policy.pose_set(),
               absl::StrCat("a pose set of this robot, ", prefix, "{id}"));
  return absl::OkStatus();
}

}  // namespace truepose::resource
