#include "server/services/recalibration.h"

#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "convert/run.h"
#include "core/base/fault.h"
#include "server/resource/resource_name.h"
#include "server/services/closures.h"
#include "server/services/jobs.h"
#include "server/services/live.h"
#include "server/services/recalibration_job.h"
#include "server/services/recalibration_requests.h"
#include "server/services/recalibration_rules.h"
#include "server/services/stored_resources.h"
#include "server/store/calibrations.h"
#include "server/store/checksum.h"
#include "server/store/jobs.h"
#include "server/store/names.h"
#include "server/store/sessions.h"

namespace truepose::services {
namespace {

using store::Snapshot;
using store::Transaction;
using Request = v1::RecalibrationRequest;

std::string NameOf(const v1::CreateRecalibrationRequestRequest& request) {
  return absl::StrCat(request.parent(), "/recalibrationRequests/",
                      request.recalibration_request_id());
}

absl::Status CheckCreate(const v1::CreateRecalibrationRequestRequest& request) {
  const Request& asked = request.recalibration_request();
  FaultList faults;
  faults.AddAll(resource::MakeKey(TypeOf<Request>(), request.parent(),
                                  request.recalibration_request_id(), "recalibration_request_id")
                    .status());
  if (asked.cause() != v1::RECALIBRATION_CAUSE_UNSPECIFIED && asked.cause() != v1::CAUSE_PERSON) {
    faults.Add("recalibration_request.cause", v1::RecalibrationCause_Name(asked.cause()),
               "CAUSE_PERSON; the server finds other causes itself");
  }
  if (!asked.raised_by().empty())
    faults.Add("recalibration_request.raised_by", asked.raised_by(), "nothing");
  v1::CalibrationOptions options;
  options.set_calibrate(asked.calibrate());
  faults.AddAll(convert::ValidateOptions(options), "recalibration_request.");
  return faults.ToStatus();
}

absl::Status CheckExpiry(const Request& asked, absl::Time now) {
  if (!asked.has_expire_time() || store::ToTime(asked.expire_time()) > now) return absl::OkStatus();
  return FaultStatus("recalibration_request.expire_time",
                     absl::FormatTime(store::ToTime(asked.expire_time()), absl::UTCTimeZone()),
                     "a time to come, or none");
}

// The request of this id, when it was made by the same content.
absl::StatusOr<std::optional<Request>> FindRepeat(
    Snapshot& snapshot, const v1::CreateRecalibrationRequestRequest& request) {
  absl::StatusOr<Request> found = GetResource<Request>(snapshot, NameOf(request));
  if (absl::IsNotFound(found.status())) return std::optional<Request>();
  TRUEPOSE_RETURN_IF_ERROR(found.status());
  const Request& asked = request.recalibration_request();
  const bool same_poses = asked.pose_set().empty() || asked.pose_set() == found->pose_set();
  const bool same_expiry = !asked.has_expire_time() || store::ToBlob(asked.expire_time()) ==
                                                           store::ToBlob(found->expire_time());
  const bool same = found->cause() == v1::CAUSE_PERSON && asked.reason() == found->reason() &&
                    asked.calibrate() == found->calibrate() && same_poses && same_expiry;
  if (same) return std::optional(*std::move(found));
  return store::Refusal(absl::StatusCode::kAlreadyExists, "recalibration_request_id",
                        absl::StrCat(found->name(), " with other values"), "a new UUID");
}

NewRequest Asked(const Caller& caller, const v1::CreateRecalibrationRequestRequest& request) {
  const Request& asked = request.recalibration_request();
  NewRequest made{.robot = request.parent(), .id = request.recalibration_request_id()};
  made.reason = asked.reason();
  made.created_by = caller.principal;
  made.calibrate = asked.calibrate();
  if (asked.has_expire_time()) made.expire_time = store::ToTime(asked.expire_time());
  return made;
}

// Names of parameters are known once the robot's model is.
absl::Status CheckCalibrate(Snapshot& snapshot, const std::string& robot_name,
                            const std::string& calibrate) {
  if (calibrate.empty() || calibrate == "all") return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot, GetLiveRobot(snapshot, robot_name, "parent"));
  v1::CalibrationOptions options;
  if (!robot.active_calibration().empty()) {
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::Calibration active,
                              store::GetCalibration(snapshot, robot.active_calibration()));
    options.set_model(active.options().model());
  }
  options.set_calibrate(calibrate);
  FaultList faults;
  faults.AddAll(convert::CheckCalibratedNames(robot.nominal_revision().nominal(), options),
                "recalibration_request.");
  return faults.ToStatus();
}

absl::Status CheckPoses(const PosesToMeasure& poses, const std::string& robot) {
  if (poses.missing.empty()) return absl::OkStatus();
  return store::Refusal(absl::StatusCode::kFailedPrecondition, "recalibration_request.pose_set",
                        absl::StrCat("nothing, and ", poses.missing),
                        absl::StrCat(robot, "/poseSets/{pose_set}, uploaded before"));
}

absl::StatusOr<Request> Create(Transaction& transaction, const Caller& caller,
                               const v1::CreateRecalibrationRequestRequest& request,
                               const PosesToMeasure& poses) {
  TRUEPOSE_RETURN_IF_ERROR(GetLiveRobot(transaction, request.parent(), "parent").status());
  TRUEPOSE_ASSIGN_OR_RETURN(auto repeat, FindRepeat(transaction, request));
  if (repeat.has_value()) return *std::move(repeat);
  TRUEPOSE_RETURN_IF_ERROR(
      CheckCalibrate(transaction, request.parent(), request.recalibration_request().calibrate()));
  TRUEPOSE_RETURN_IF_ERROR(CheckExpiry(request.recalibration_request(), transaction.now()));
  return RaiseRequest(transaction, Asked(caller, request), poses);
}

// One step of a request by a caller: `change` sets what goes with it.
template <typename Asked, typename Change>
absl::StatusOr<Request> Step(const CallContext& call, const Asked& asked, v1::RecalibrationState to,
                             Change change) {
  return WriteOnce(call, asked, [&](Transaction& transaction) -> absl::StatusOr<Request> {
    TRUEPOSE_ASSIGN_OR_RETURN(Request request,
                              GetLiveResource<Request>(transaction, asked.name(), "name"));
    TRUEPOSE_RETURN_IF_ERROR(CheckStep(request, to));
    TRUEPOSE_RETURN_IF_ERROR(change(transaction, request));
    return request;
  });
}

std::string RobotOf(const Request& request) {
  return request.name().substr(0, request.name().find("/recalibrationRequests/"));
}

absl::Status CheckMeasured(Snapshot& snapshot, const Request& request, const std::string& name) {
  if (name.empty())
    return FaultStatus("session", "nothing", "sessions/{uuid} that the readings go to");
  TRUEPOSE_RETURN_IF_ERROR(store::ParseSessionName(name, "session").status());
  const absl::StatusOr<v1::Session> session = store::GetSession(snapshot, name);
  if (absl::IsNotFound(session.status()) || (session.ok() && session->has_delete_time()))
    return store::NotFound(name, "session");
  TRUEPOSE_RETURN_IF_ERROR(session.status());
  const std::string robot = RobotOf(request);
  if (session->robot() == robot) return absl::OkStatus();
  return store::Refusal(absl::StatusCode::kFailedPrecondition, "session",
                        absl::StrCat(name, " of ", session->robot()),
                        absl::StrCat("a session of ", robot));
}

// A step where the state or session changes, else only the number.
absl::Status Measure(Transaction& transaction, const std::string& principal,
                     const v1::ReportMeasuringRequest& asked, Request& request) {
  const std::string session = asked.session().empty() ? request.session() : asked.session();
  TRUEPOSE_RETURN_IF_ERROR(CheckMeasured(transaction, request, session));
  const bool goes_on = request.state() == v1::REQUEST_MEASURING && request.session() == session;
  if (goes_on && request.readings_taken() == asked.readings_taken()) return absl::OkStatus();
  request.set_session(session);
  request.set_readings_taken(asked.readings_taken());
  if (goes_on) return resource::Replace(transaction, TypeOf<Request>(), request);
  return AppendStep(transaction, v1::REQUEST_MEASURING, principal, session, request);
}

absl::Status CreateJob(Transaction& transaction, const Caller& caller, const std::string& split,
                       Request& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(const auto asked, JobFor(transaction, request, split));
  TRUEPOSE_ASSIGN_OR_RETURN(v1::CalibrationJob frozen, FreezeInput(transaction, asked));
  frozen.set_created_by(caller.principal);
  frozen.set_created_by_machine(caller.is_machine);
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::CalibrationJob job,
                            store::CreateJob(transaction, store::NewUuid(), frozen));
  TRUEPOSE_RETURN_IF_ERROR(BeginCalibrating(transaction, job, caller.principal));
  TRUEPOSE_ASSIGN_OR_RETURN(request, GetResource<Request>(transaction, request.name()));
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<Request> CreateRecalibrationRequest(
    const CallContext& call, const v1::CreateRecalibrationRequestRequest& request) {
  TRUEPOSE_RETURN_IF_ERROR(CheckCreate(request));
  // What is there already is answered without the work of choosing poses.
  TRUEPOSE_ASSIGN_OR_RETURN(const auto repeat, call.store.Read([&](Snapshot& snapshot) {
    return FindRepeat(snapshot, request);
  }));
  PosesToMeasure poses;
  if (!repeat.has_value()) {
    TRUEPOSE_ASSIGN_OR_RETURN(
        poses, PlanPoses(call.store, request.parent(), request.recalibration_request().pose_set()));
    TRUEPOSE_RETURN_IF_ERROR(CheckPoses(poses, request.parent()));
  }
  return WriteOnce(call, request, [&](Transaction& transaction) {
    return Create(transaction, call.caller, request, poses);
  });
}

absl::StatusOr<Request> AcknowledgeRecalibration(
    const CallContext& call, const v1::AcknowledgeRecalibrationRequest& request) {
  return Step(call, request, v1::REQUEST_ACKNOWLEDGED,
              [&](Transaction& transaction, Request& changed) {
                return AppendStep(transaction, v1::REQUEST_ACKNOWLEDGED, call.caller.principal, "",
                                  changed);
              });
}

absl::StatusOr<Request> ReportMeasuring(const CallContext& call,
                                        const v1::ReportMeasuringRequest& request) {
  if (request.readings_taken() < 0)
    return FaultStatus("readings_taken", absl::StrCat(request.readings_taken()), "0 or more");
  return Step(call, request, v1::REQUEST_MEASURING,
              [&](Transaction& transaction, Request& changed) {
                return Measure(transaction, call.caller.principal, request, changed);
              });
}

absl::StatusOr<Request> CalibrateForRequest(const CallContext& call,
                                            const v1::CalibrateForRequestRequest& request) {
  auto changed =
      Step(call, request, v1::REQUEST_CALIBRATING, [&](Transaction& transaction, Request& asked) {
        return CreateJob(transaction, call.caller, request.split(), asked);
      });
  if (changed.ok()) call.engine.Wake();
  return changed;
}

absl::StatusOr<Request> DeclineRecalibration(const CallContext& call,
                                             const v1::DeclineRecalibrationRequest& request) {
  if (request.reason().empty())
    return FaultStatus("reason", "nothing", "why the robot is not recalibrated");
  return Step(call, request, v1::REQUEST_DECLINED, [&](Transaction& transaction, Request& changed) {
    return AppendStep(transaction, v1::REQUEST_DECLINED, call.caller.principal, request.reason(),
                      changed);
  });
}

absl::StatusOr<v1::AgentReport> ReportAgent(const CallContext& call,
                                            const v1::ReportAgentRequest& request) {
  const resource::ResourceType& type = TypeOf<v1::AgentReport>();
  const v1::AgentReport& report = request.agent_report();
  FaultList faults, inner;
  const auto key = resource::ParseName(type, report.name(), "agent_report.name");
  faults.AddAll(key.status());
  type.check(report, inner);
  if (!inner.empty()) faults.AddAll(inner.ToStatus(), "agent_report.");
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  v1::AgentReport content = report;
  resource::PrepareContent(type, call.caller.principal, content);
  return call.store.Write([&](Transaction& transaction) -> absl::StatusOr<v1::AgentReport> {
    TRUEPOSE_RETURN_IF_ERROR(
        GetLiveRobot(transaction, report.robot(), "agent_report.robot").status());
    const auto stored = GetResource<v1::AgentReport>(transaction, report.name());
    v1::AgentReport latest = content;
    if (absl::IsNotFound(stored.status())) {
      TRUEPOSE_RETURN_IF_ERROR(
          resource::Create(transaction, type, *key, content, "agent_report", latest));
      return latest;
    }
    TRUEPOSE_RETURN_IF_ERROR(stored.status());
    resource::CopyServerFields(type, *stored, latest);
    TRUEPOSE_RETURN_IF_ERROR(resource::Replace(transaction, type, latest));
    return latest;
  });
}

}  // namespace truepose::services
