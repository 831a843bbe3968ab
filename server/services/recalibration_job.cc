#include "server/services/recalibration_job.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "convert/run.h"
#include "core/base/fault.h"
#include "server/jobs/job_state.h"
#include "server/services/live.h"
#include "server/services/recalibration_requests.h"
#include "server/services/recalibration_rules.h"
#include "server/services/stored_resources.h"
#include "server/store/calibrations.h"
#include "server/store/sessions.h"

namespace truepose::services {
namespace {

using store::Snapshot;
using store::Transaction;

constexpr char kField[] = "recalibration_request";

bool HasColumn(const v1::Session& session, const std::string& column) {
  const auto& columns = session.extra_columns();
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

// The options of `active` for another session.
v1::CalibrationOptions OptionsAs(const v1::Calibration& active, const v1::Session& session) {
  v1::CalibrationOptions options = active.options();
  options.clear_split();
  if (!HasColumn(session, options.group_column())) options.clear_group_column();
  if (options.prior() == "calibration") options.clear_prior();
  options.clear_prior_calibration();
  return options;
}

// What a partial recalibration holds belongs to the nominal that it was found with.
absl::Status CheckSameNominal(const v1::Calibration& active, const v1::Session& session) {
  if (active.nominal_revision() == session.nominal_revision()) return absl::OkStatus();
  return store::Refusal(
      absl::StatusCode::kFailedPrecondition, "calibrate",
      absl::StrCat("a part, of ", session.name(), " for ", session.nominal_revision()),
      absl::StrCat("all, or a session for ", active.nominal_revision(), " of the active ",
                   active.name()));
}

absl::StatusOr<v1::CalibrationOptions> OptionsFor(Snapshot& snapshot,
                                                  const v1::RecalibrationRequest& request,
                                                  const std::string& robot_name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot, GetLiveRobot(snapshot, robot_name, "name"));
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Session session,
                            store::GetSession(snapshot, request.session()));
  const bool is_partial = !request.calibrate().empty() && request.calibrate() != "all";
  v1::CalibrationOptions options;
  if (!robot.active_calibration().empty()) {
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::Calibration active,
                              store::GetCalibration(snapshot, robot.active_calibration()));
    options = OptionsAs(active, session);
    if (is_partial) {
      TRUEPOSE_RETURN_IF_ERROR(CheckSameNominal(active, session));
      options.set_prior("calibration");
      *options.mutable_prior_calibration() = convert::PriorOf(active);
    }
  }
  options.set_calibrate(request.calibrate());
  return options;
}

std::string RobotOf(const v1::RecalibrationRequest& request) {
  const std::string& name = request.name();
  return name.substr(0, name.find("/recalibrationRequests/"));
}

// "FAILED: sessions[0].readings: ..." in one line.
std::string EndOf(const v1::CalibrationJob& job) {
  std::string text = absl::StrCat(job.name(), " ", v1::JobState_Name(job.state()));
  if (job.error().message().empty()) return text;
  absl::StrAppend(&text, ": ", job.error().message());
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

absl::StatusOr<v1::CreateCalibrationJobRequest> JobFor(Snapshot& snapshot,
                                                       const v1::RecalibrationRequest& request,
                                                       const std::string& split) {
  v1::CreateCalibrationJobRequest job;
  job.set_robot(RobotOf(request));
  job.add_sessions(request.session());
  job.set_recalibration_request(request.name());
  TRUEPOSE_ASSIGN_OR_RETURN(*job.mutable_options(), OptionsFor(snapshot, request, job.robot()));
  job.mutable_options()->set_split(split.empty() ? kSplitOfRequest : split);
  TRUEPOSE_RETURN_IF_ERROR(convert::ValidateOptions(job.options()));
  return job;
}

absl::Status BeginCalibrating(Transaction& transaction, const v1::CalibrationJob& job,
                              const std::string& principal) {
  const std::string& name = job.recalibration_request();
  if (name.empty() || jobs::IsTerminal(job.state())) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(v1::RecalibrationRequest request,
                            GetLiveResource<v1::RecalibrationRequest>(transaction, name, kField));
  if (request.job() == job.name()) return absl::OkStatus();
  if (RobotOf(request) != job.robot())
    return FaultStatus(kField, name, absl::StrCat("a request of ", job.robot()));
  TRUEPOSE_RETURN_IF_ERROR(CheckStep(request, v1::REQUEST_CALIBRATING));
  request.set_job(job.name());
  return AppendStep(transaction, v1::REQUEST_CALIBRATING, principal, job.name(), request);
}

absl::Status MoveRequestOfJob(Transaction& transaction, const v1::CalibrationJob& job) {
  const std::string& name = job.recalibration_request();
  if (name.empty()) return absl::OkStatus();
  auto request = GetLiveResource<v1::RecalibrationRequest>(transaction, name, kField);
  // A job of an older server may name anything.
  if (absl::IsNotFound(request.status()) || absl::IsInvalidArgument(request.status()))
    return absl::OkStatus();
  TRUEPOSE_RETURN_IF_ERROR(request.status());
  if (request->state() != v1::REQUEST_CALIBRATING || request->job() != job.name())
    return absl::OkStatus();
  if (job.state() == v1::SUCCEEDED) {
    request->set_calibration(job.calibration());
    return AppendStep(transaction, v1::REQUEST_DONE, kServerPrincipal, job.calibration(), *request);
  }
  request->clear_job();
  return AppendStep(transaction, v1::REQUEST_MEASURING, kServerPrincipal, EndOf(job), *request);
}

}  // namespace truepose::services
