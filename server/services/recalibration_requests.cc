#include "server/services/recalibration_requests.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "server/resource/resource_name.h"
#include "server/services/recalibration_rules.h"
#include "server/services/stored_resources.h"
#include "server/store/checksum.h"

namespace truepose::services {
namespace {

// What causes it again is on record by itself; a signal that chatters must not grow a request,
// which is written and told whole with each step.
constexpr int kMostSteps = 100;

using store::Transaction;

void AddStep(const Transaction& transaction, v1::RecalibrationState to,
             const std::string& principal, const std::string& reason,
             v1::RecalibrationRequest& request) {
  request.set_state(to);
  v1::RecalibrationStep& step = *request.add_steps();
  step.set_state(to);
  step.set_principal(principal);
  step.set_reason(reason);
  *step.mutable_time() = store::ToTimestamp(transaction.now());
}

// The shortest time that a policy of the robot gives.
absl::StatusOr<absl::Duration> ExpireAfter(store::Snapshot& snapshot, const std::string& robot) {
  TRUEPOSE_ASSIGN_OR_RETURN(const auto policies,
                            AllOfRobot<v1::RecalibrationPolicy>(snapshot, robot));
  absl::Duration least = absl::InfiniteDuration();
  for (const v1::RecalibrationPolicy& policy : policies) {
    if (policy.has_expire_after())
      least = std::min(least, store::ToDuration(policy.expire_after()));
  }
  return least == absl::InfiniteDuration() ? kExpireAfter : least;
}

absl::Status CheckNoneOpen(store::Snapshot& snapshot, const std::string& robot) {
  TRUEPOSE_ASSIGN_OR_RETURN(const auto open, FindOpenRequest(snapshot, robot));
  if (!open.has_value()) return absl::OkStatus();
  return store::Refusal(absl::StatusCode::kAlreadyExists, "parent",
                        absl::StrCat(robot, ", whose ", open->name(), " is ",
                                     v1::RecalibrationState_Name(open->state())),
                        "a robot without an open request; finish or decline that one");
}

absl::StatusOr<std::string> StorePoses(Transaction& transaction, const std::string& robot,
                                       const std::string& request_id, const PosesToMeasure& poses) {
  if (!poses.thinned.has_value()) return poses.pose_set;
  const resource::ResourceType& type = TypeOf<v1::PoseSet>();
  TRUEPOSE_ASSIGN_OR_RETURN(
      const store::ResourceKey key,
      resource::MakeKey(type, robot, absl::StrCat("recalibration-", request_id), "pose_set_id"));
  v1::PoseSet stored;
  TRUEPOSE_RETURN_IF_ERROR(
      resource::Create(transaction, type, key, *poses.thinned, "pose_set", stored));
  return stored.name();
}

absl::StatusOr<v1::RecalibrationRequest> ContentOf(Transaction& transaction,
                                                   const NewRequest& request) {
  v1::RecalibrationRequest content;
  content.set_cause(request.cause);
  content.set_reason(request.reason);
  content.set_created_by(request.created_by);
  content.set_raised_by(request.raised_by);
  content.set_calibrate(request.calibrate);
  TRUEPOSE_ASSIGN_OR_RETURN(const absl::Duration after, ExpireAfter(transaction, request.robot));
  *content.mutable_expire_time() =
      store::ToTimestamp(request.expire_time.value_or(transaction.now() + after));
  AddStep(transaction, v1::REQUEST_PENDING, request.created_by, request.reason, content);
  return content;
}

}  // namespace

absl::StatusOr<std::optional<v1::RecalibrationRequest>> FindOpenRequest(store::Snapshot& snapshot,
                                                                        const std::string& robot) {
  TRUEPOSE_ASSIGN_OR_RETURN(auto requests,
                            AllOfRobot<v1::RecalibrationRequest>(snapshot, robot, true));
  for (v1::RecalibrationRequest& request : requests)
    if (IsOpen(request.state())) return std::optional(std::move(request));
  return std::optional<v1::RecalibrationRequest>();
}

absl::StatusOr<v1::RecalibrationRequest> RaiseRequest(Transaction& transaction,
                                                      const NewRequest& request,
                                                      const PosesToMeasure& poses) {
  const resource::ResourceType& type = TypeOf<v1::RecalibrationRequest>();
  const std::string id = request.id.empty() ? store::NewUuid() : request.id;
  TRUEPOSE_ASSIGN_OR_RETURN(const store::ResourceKey key,
                            resource::MakeKey(type, request.robot, id, "recalibration_request_id"));
  TRUEPOSE_RETURN_IF_ERROR(CheckNoneOpen(transaction, request.robot));
  TRUEPOSE_ASSIGN_OR_RETURN(v1::RecalibrationRequest content, ContentOf(transaction, request));
  TRUEPOSE_ASSIGN_OR_RETURN(*content.mutable_pose_set(),
                            StorePoses(transaction, request.robot, id, poses));
  if (!poses.missing.empty())
    content.mutable_steps(0)->mutable_reason()->append(
        absl::StrCat(". No pose set: ", poses.missing));
  v1::RecalibrationRequest stored;
  TRUEPOSE_RETURN_IF_ERROR(
      resource::Create(transaction, type, key, content, "recalibration_request", stored));
  return stored;
}

absl::StatusOr<std::optional<v1::RecalibrationRequest>> RaiseOrNote(Transaction& transaction,
                                                                    const NewRequest& request,
                                                                    const PosesToMeasure* poses) {
  TRUEPOSE_ASSIGN_OR_RETURN(auto open, FindOpenRequest(transaction, request.robot));
  if (open.has_value()) {
    if (open->steps_size() >= kMostSteps) return std::optional<v1::RecalibrationRequest>();
    TRUEPOSE_RETURN_IF_ERROR(AppendStep(transaction, open->state(), request.created_by,
                                        absl::StrCat("also: ", request.reason), *open));
    return std::optional<v1::RecalibrationRequest>();
  }
  if (poses == nullptr) return NeedPoses();
  TRUEPOSE_ASSIGN_OR_RETURN(v1::RecalibrationRequest raised,
                            RaiseRequest(transaction, request, *poses));
  return std::optional(std::move(raised));
}

absl::Status AppendStep(Transaction& transaction, v1::RecalibrationState to,
                        const std::string& principal, const std::string& reason,
                        v1::RecalibrationRequest& request) {
  AddStep(transaction, to, principal, reason, request);
  return resource::Replace(transaction, TypeOf<v1::RecalibrationRequest>(), request);
}

}  // namespace truepose::services
