#include "server/services/jobs.h"

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "convert/run.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/services/closures.h"
#include "server/services/live.h"
#include "server/services/recalibration_job.h"
#include "server/store/jobs.h"
#include "server/store/names.h"
#include "server/store/robots.h"
#include "server/store/sessions.h"

namespace truepose::services {
namespace {

using store::Snapshot;
using store::Transaction;

absl::Status CheckSessionNames(const v1::CreateCalibrationJobRequest& request) {
  FaultList faults;
  if (request.sessions().empty()) faults.Add("sessions", "none", "at least one sealed session");
  std::set<std::string> seen;
  for (int i = 0; i < request.sessions_size(); ++i) {
    const std::string field = absl::StrCat("sessions[", i, "]");
    faults.AddAll(store::ParseSessionName(request.sessions(i), field).status());
    if (!seen.insert(request.sessions(i)).second) {
      faults.Add(field, absl::StrCat(request.sessions(i), " again"), "each session once");
    }
  }
  return faults.ToStatus();
}

absl::Status CheckRequest(const v1::CreateCalibrationJobRequest& request) {
  FaultList faults;
  faults.AddAll(store::CheckUuid(request.job_id(), "job_id"));
  faults.AddAll(store::ParseRobotName(request.robot(), "robot").status());
  faults.AddAll(CheckSessionNames(request));
  faults.AddAll(convert::ValidateOptions(request.options()));
  return faults.ToStatus();
}

absl::StatusOr<std::vector<v1::Session>> SessionsOf(
    Snapshot& snapshot, const v1::CreateCalibrationJobRequest& request) {
  std::vector<v1::Session> sessions;
  for (const std::string& name : request.sessions()) {
    TRUEPOSE_ASSIGN_OR_RETURN(v1::Session session, store::GetSession(snapshot, name));
    sessions.push_back(std::move(session));
  }
  return sessions;
}

// Every session that can't be calibrated as it stands, with what it is and what it should be.
absl::Status CheckSessions(const std::vector<v1::Session>& sessions, const std::string& robot) {
  FaultList faults;
  for (size_t i = 0; i < sessions.size(); ++i) {
    const v1::Session& session = sessions[i];
    const std::string field = absl::StrCat("sessions[", i, "]");
    const std::string& revision = sessions.front().nominal_revision();
    if (session.robot() != robot) {
      faults.Add(field, absl::StrCat(session.name(), " of ", session.robot()),
                 absl::StrCat("a session of ", robot));
    } else if (session.nominal_revision() != revision) {
      faults.Add(field, absl::StrCat(session.name(), " of ", session.nominal_revision()),
                 absl::StrCat("a session of ", revision, " as sessions[0]"));
    }
    if (session.has_delete_time()) {
      faults.Add(field, absl::StrCat(session.name(), ", which is deleted"),
                 "a session that is not; UndeleteSession brings it back");
    }
    if (session.state() != v1::SEALED) {
      faults.Add(field, absl::StrCat(session.name(), " ", v1::SessionState_Name(session.state())),
                 "SEALED");
    }
  }
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

// The job as it would be stored, and what it would do.
absl::StatusOr<v1::CalibrationJob> Preview(const CallContext& call,
                                           const v1::CreateCalibrationJobRequest& request) {
  v1::CalibrationJob job;
  TRUEPOSE_ASSIGN_OR_RETURN(
      const v1::CalibrationInput input,
      call.store.Read([&](Snapshot& snapshot) -> absl::StatusOr<v1::CalibrationInput> {
        TRUEPOSE_ASSIGN_OR_RETURN(job, FreezeInput(snapshot, request));
        return store::PreviewJobInput(snapshot, request.job_id(), job);
      }));
  TRUEPOSE_ASSIGN_OR_RETURN(*job.mutable_preview(), convert::RunPreview(input));
  job.set_name(store::JobName(request.job_id()));
  return job;
}

}  // namespace

absl::StatusOr<v1::CalibrationJob> FreezeInput(Snapshot& snapshot,
                                               const v1::CreateCalibrationJobRequest& request) {
  TRUEPOSE_RETURN_IF_ERROR(GetLiveRobot(snapshot, request.robot(), "robot").status());
  TRUEPOSE_ASSIGN_OR_RETURN(const auto sessions, SessionsOf(snapshot, request));
  TRUEPOSE_RETURN_IF_ERROR(CheckSessions(sessions, request.robot()));
  const std::string& revision = sessions.front().nominal_revision();
  TRUEPOSE_ASSIGN_OR_RETURN(const auto nominal, store::GetNominalRevision(snapshot, revision));
  std::vector<std::string> digests;
  for (const v1::Session& session : sessions) digests.push_back(session.digest());
  v1::CalibrationJob job;
  job.set_robot(request.robot());
  *job.mutable_sessions() = request.sessions();
  *job.mutable_options() = request.options();
  job.set_nominal_revision(revision);
  job.set_priority(request.priority());
  if (request.has_deadline()) *job.mutable_deadline() = request.deadline();
  job.set_recalibration_request(request.recalibration_request());
  job.set_input_digest(convert::JobInputDigest(nominal.digest(), digests, request.options()));
  return job;
}

absl::StatusOr<v1::CalibrationJob> CreateCalibrationJob(
    const CallContext& call, const v1::CreateCalibrationJobRequest& request) {
  TRUEPOSE_RETURN_IF_ERROR(CheckRequest(request));
  if (request.validate_only()) return Preview(call, request);
  const store::RequestKey key =
      resource::KeyOf(call.caller.principal, request, request.request_id());
  const auto create = [&](Transaction& transaction) -> absl::StatusOr<v1::CalibrationJob> {
    TRUEPOSE_ASSIGN_OR_RETURN(v1::CalibrationJob frozen, FreezeInput(transaction, request));
    frozen.set_created_by(call.caller.principal);
    frozen.set_created_by_machine(call.caller.is_machine);
    TRUEPOSE_ASSIGN_OR_RETURN(v1::CalibrationJob job,
                              store::CreateJob(transaction, request.job_id(), frozen));
    TRUEPOSE_RETURN_IF_ERROR(BeginCalibrating(transaction, job, call.caller.principal));
    return job;
  };
  // All of it once: a repeat gets its answer also when the robot was deleted meanwhile.
  auto job = call.store.Write([&](Transaction& transaction) {
    return resource::Once<v1::CalibrationJob>(transaction, key, create);
  });
  if (job.ok()) call.engine.Wake();
  return job;
}

absl::StatusOr<v1::CalibrationJob> GetCalibrationJob(const CallContext& call,
                                                     const v1::GetCalibrationJobRequest& request) {
  return call.engine.Get(request.name());
}

absl::StatusOr<v1::ListCalibrationJobsResponse> ListCalibrationJobs(
    const CallContext& call, const v1::ListCalibrationJobsRequest& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(const auto filter, FilterOf<v1::CalibrationJob>(request));
  TRUEPOSE_ASSIGN_OR_RETURN(auto page, call.store.Read([&](Snapshot& snapshot) {
    return store::ListJobs(snapshot, request.robot(), PageOf(request), filter);
  }));
  return ToResponse(std::move(page), &v1::ListCalibrationJobsResponse::mutable_jobs);
}

absl::StatusOr<v1::CalibrationJob> CancelCalibrationJob(
    const CallContext& call, const v1::CancelCalibrationJobRequest& request) {
  const store::RequestKey key =
      resource::KeyOf(call.caller.principal, request, request.request_id());
  return call.engine.Cancel(request.name(), [&](Transaction& transaction, const auto& cancel) {
    return resource::Once<v1::CalibrationJob>(transaction, key, [&](auto&) { return cancel(); });
  });
}

absl::StatusOr<std::unique_ptr<jobs::Subscription>> WatchCalibrationJob(
    const CallContext& call, const v1::WatchCalibrationJobRequest& request,
    jobs::WatchCallbacks callbacks) {
  return call.engine.Watch(request.name(), std::move(callbacks));
}

}  // namespace truepose::services
