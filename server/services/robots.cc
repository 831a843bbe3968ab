#include "server/services/robots.h"

#include <cmath>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "convert/run.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "google/protobuf/util/message_differencer.h"
#include "server/resource/etag.h"
#include "server/resource/field_mask.h"
#include "server/services/closures.h"
#include "server/services/live.h"
#include "server/services/release_rules.h"
#include "server/services/table_jobs.h"
#include "server/services/table_spec_check.h"
#include "server/store/jobs.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/robots.h"

namespace truepose::services {

using store::Snapshot;
using store::Transaction;

namespace {

// Only the server sets these, beside the standard fields.
const std::vector<std::string>& OutputOnly() {
  static const auto& fields = *new std::vector<std::string>{
      "nominal_revision", "active_calibration", "active_compensation_table"};
  return fields;
}

void CheckLimit(double limit, const char* field, FaultList& faults) {
  if (std::isfinite(limit) && limit >= 0.0) return;
  faults.Add(absl::StrCat("robot.limits.", field), absl::StrCat(limit), "mm, 0 = none");
}

void CheckSettings(const v1::Robot& robot, FaultList& faults) {
  CheckLimit(robot.limits().control_rms_mm(), "control_rms_mm", faults);
  CheckLimit(robot.limits().change_mm(), "change_mm", faults);
  CheckLimit(robot.limits().drift_rms_mm(), "drift_rms_mm", faults);
  if (!v1::ReleasePolicy_IsValid(robot.release_policy())) {
    faults.Add("robot.release_policy", absl::StrCat(static_cast<int>(robot.release_policy())),
               "TWO_PERSON, ONE_PERSON or AUTOMATIC_WITHIN_LIMITS");
  }
}

// Who sets how a calibration gets to the robot could else release by that: a machine, or one person
// where two are asked for.
absl::Status CheckMaySetRelease(const Caller& caller, const v1::Robot& before,
                                const v1::Robot& after) {
  const bool same = before.release_policy() == after.release_policy() &&
                    before.limits().control_rms_mm() == after.limits().control_rms_mm() &&
                    before.limits().change_mm() == after.limits().change_mm();
  return same ? absl::OkStatus() : CheckIsAdmin(caller);
}

// A robot with another spec than before: which table is to be applied, and one that is not there
// yet is built.
absl::StatusOr<v1::Robot> FollowTableSpec(Transaction& transaction, const Caller& caller,
                                          const v1::Robot& robot) {
  TRUEPOSE_RETURN_IF_ERROR(
      QueueActiveTable(transaction, robot, caller.principal, caller.is_machine));
  TRUEPOSE_RETURN_IF_ERROR(RefreshTableToApply(transaction, robot.name()));
  return store::GetRobot(transaction, robot.name());
}

// @param of_spec of the table_spec that the request leaves, if that is another one than before.
absl::StatusOr<v1::Robot> Update(Transaction& transaction, const Caller& caller,
                                 const v1::UpdateRobotRequest& request,
                                 const absl::Status& of_spec) {
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Robot robot,
                            GetLiveRobot(transaction, request.robot().name(), "robot.name"));
  TRUEPOSE_RETURN_IF_ERROR(resource::CheckEtag(robot.etag(), request.robot().etag()));
  const v1::Robot before = robot;
  TRUEPOSE_RETURN_IF_ERROR(
      resource::ApplyUpdate(request.robot(), request.update_mask(), OutputOnly(), robot));
  const bool same_spec = HasSameSpec(before, robot);
  FaultList faults;
  CheckSettings(robot, faults);
  if (!same_spec) faults.AddAll(of_spec);
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  TRUEPOSE_RETURN_IF_ERROR(CheckMaySetRelease(caller, before, robot));
  if (google::protobuf::util::MessageDifferencer::Equals(before, robot)) return robot;
  TRUEPOSE_ASSIGN_OR_RETURN(robot, store::PutRobot(transaction, robot));
  return same_spec ? robot : FollowTableSpec(transaction, caller, robot);
}

absl::Status CheckSpecOfNew(const CallContext& call, const v1::CreateRobotRequest& request) {
  v1::Robot robot;
  if (request.robot().has_table_spec()) *robot.mutable_table_spec() = request.robot().table_spec();
  *robot.mutable_nominal_revision()->mutable_nominal() = request.nominal();
  return CheckSpecBuildable(call, robot);
}

absl::Status CheckNoJobs(Transaction& transaction, const std::string& robot) {
  for (const v1::JobState state : {v1::PENDING, v1::RUNNING}) {
    TRUEPOSE_ASSIGN_OR_RETURN(const auto names, store::JobsInState(transaction, state));
    for (const std::string& name : names) {
      TRUEPOSE_ASSIGN_OR_RETURN(const v1::CalibrationJob job, store::GetJob(transaction, name));
      if (job.robot() != robot) continue;
      return store::Refusal(absl::StatusCode::kFailedPrecondition, "name",
                            absl::StrCat(robot, ", whose ", name, " has not ended"),
                            "a robot without jobs that run or wait; cancel them first");
    }
  }
  return absl::OkStatus();
}

absl::StatusOr<v1::Robot> SetDeleted(Transaction& transaction, const std::string& name,
                                     const std::string& etag, bool deleted) {
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Robot robot, store::GetRobot(transaction, name));
  TRUEPOSE_RETURN_IF_ERROR(resource::CheckEtag(robot.etag(), etag));
  if (robot.has_delete_time() == deleted) return robot;
  if (deleted) TRUEPOSE_RETURN_IF_ERROR(CheckNoJobs(transaction, name));
  robot.clear_delete_time();
  if (deleted) *robot.mutable_delete_time() = store::ToTimestamp(transaction.now());
  return store::PutRobot(transaction, robot);
}

}  // namespace

absl::StatusOr<v1::Robot> CreateRobot(const CallContext& call,
                                      const v1::CreateRobotRequest& request) {
  FaultList faults;
  faults.AddAll(store::CheckRobotId(request.robot_id(), "robot_id"));
  const absl::Status nominal = convert::ValidateNominal(request.nominal());
  faults.AddAll(nominal, "nominal.");
  CheckSettings(request.robot(), faults);
  if (nominal.ok()) faults.AddAll(CheckSpecOfNew(call, request));
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  TRUEPOSE_RETURN_IF_ERROR(CheckMaySetRelease(call.caller, v1::Robot(), request.robot()));
  const std::string digest = convert::NominalDigest(request.nominal());
  return WriteOnce(call, request, [&](Transaction& transaction) {
    return store::CreateRobot(transaction, request.robot_id(), request.nominal(), digest,
                              request.robot());
  });
}

absl::StatusOr<v1::Robot> UpdateRobot(const CallContext& call,
                                      const v1::UpdateRobotRequest& request) {
  const absl::Status of_spec = CheckSpecBuildable(call, request);
  auto robot = WriteOnce(call, request, [&](Transaction& transaction) {
    return Update(transaction, call.caller, request, of_spec);
  });
  if (robot.ok()) call.engine.Wake();
  return robot;
}

absl::StatusOr<v1::Robot> DeleteRobot(const CallContext& call,
                                      const v1::DeleteRobotRequest& request) {
  return WriteOnce(call, request, [&](Transaction& transaction) {
    return SetDeleted(transaction, request.name(), request.etag(), true);
  });
}

absl::StatusOr<v1::Robot> UndeleteRobot(const CallContext& call,
                                        const v1::UndeleteRobotRequest& request) {
  return WriteOnce(call, request, [&](Transaction& transaction) {
    return SetDeleted(transaction, request.name(), "", false);
  });
}

absl::StatusOr<v1::Robot> GetRobot(const CallContext& call, const v1::GetRobotRequest& request) {
  return call.store.Read(
      [&](Snapshot& snapshot) { return store::GetRobot(snapshot, request.name()); });
}

absl::StatusOr<v1::ListRobotsResponse> ListRobots(const CallContext& call,
                                                  const v1::ListRobotsRequest& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(const auto filter, FilterOf<v1::Robot>(request));
  TRUEPOSE_ASSIGN_OR_RETURN(auto page, call.store.Read([&](Snapshot& snapshot) {
    return store::ListRobots(snapshot, PageOf(request), filter);
  }));
  return ToResponse(std::move(page), &v1::ListRobotsResponse::mutable_robots);
}

absl::StatusOr<v1::NominalRevision> CreateNominalRevision(
    const CallContext& call, const v1::CreateNominalRevisionRequest& request) {
  FaultList faults;
  faults.AddAll(store::ParseRobotName(request.parent(), "parent").status());
  faults.AddAll(convert::ValidateNominal(request.nominal()), "nominal.");
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  const std::string digest = convert::NominalDigest(request.nominal());
  return WriteOnce(call, request, [&](Transaction& transaction) {
    return store::AddNominalRevision(transaction, request.parent(), request.nominal(), digest);
  });
}

absl::StatusOr<v1::NominalRevision> GetNominalRevision(
    const CallContext& call, const v1::GetNominalRevisionRequest& request) {
  return call.store.Read(
      [&](Snapshot& snapshot) { return store::GetNominalRevision(snapshot, request.name()); });
}

absl::StatusOr<v1::ListNominalRevisionsResponse> ListNominalRevisions(
    const CallContext& call, const v1::ListNominalRevisionsRequest& request) {
  // The store calls the field `robot_name`, this request calls it `parent`.
  TRUEPOSE_RETURN_IF_ERROR(store::ParseRobotName(request.parent(), "parent").status());
  TRUEPOSE_ASSIGN_OR_RETURN(auto page, call.store.Read([&](Snapshot& snapshot) {
    return store::ListNominalRevisions(snapshot, request.parent(), PageOf(request));
  }));
  return ToResponse(std::move(page), &v1::ListNominalRevisionsResponse::mutable_nominal_revisions);
}

}  // namespace truepose::services
