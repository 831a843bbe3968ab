// truepose calibrate on a server: a job over sealed sessions.
#include <filesystem>
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/cli/commands/calibrate.h"
#include "client/cli/commands/wait.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

constexpr char kHint[] =
    "`truepose robot list` and `truepose session list` show what this server has.";

// Files where names belong are the likeliest mistake.
absl::Status CheckNames(const CalibrateOptions& options) {
  for (const std::string& session : options.sessions) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(session, error)) continue;
    return OptionFault("--session", session,
                       "the UUID of a session on the server; `truepose session import` brings a "
                       "file there, --local "
                       "uses it here");
  }
  return absl::OkStatus();
}

// The nominal robot that the job will take: that of its sessions.
absl::StatusOr<v1::Nominal> NominalOf(const client::Client& client, const std::string& session) {
  v1::GetSessionRequest get_session;
  get_session.set_name(session);
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Session found, client.GetSession(get_session));
  v1::GetNominalRevisionRequest get_revision;
  get_revision.set_name(found.nominal_revision());
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::NominalRevision revision,
                            client.GetNominalRevision(get_revision));
  return revision.nominal();
}

absl::StatusOr<v1::CalibrationJob> CreateJob(const client::Client& client,
                                             const CalibrateOptions& options) {
  v1::CreateCalibrationJobRequest request;
  request.set_job_id(RandomUuid());
  request.set_robot(RobotName(options.robot));
  for (const std::string& session : options.sessions) request.add_sessions(SessionName(session));
  *request.mutable_options() = options.calibration;
  request.set_validate_only(options.preview);
  TRUEPOSE_RETURN_IF_ERROR(WriteIdentificationOptions(
      options.identification,
      [&](const std::string& typed) -> absl::StatusOr<v1::Calibration> {
        v1::GetCalibrationRequest get;
        const auto name = CalibrationName(typed);
        if (!name.ok())
          return OptionFault(
              "--prior", typed,
              "none, tolerance, a file of --output, or a calibration such as ur10#1");
        get.set_name(*name);
        auto calibration = client.GetCalibration(get);
        if (calibration.ok()) return calibration;
        return WithHint(calibration.status(), absl::StatusCode::kNotFound, kCalibrationHint);
      },
      [&] { return NominalOf(client, request.sessions(0)); }, request.mutable_options()));
  return client.CreateCalibrationJob(request);
}

absl::Status ReplyJob(const Invocation& invocation, const v1::CalibrationJob& job) {
  return Reply(invocation, job, [&] {
    return absl::StrCat("Job ", ShortName(job.name()), "\nNext: truepose job watch ",
                        ShortName(job.name()), "\n");
  });
}

absl::Status CalibrateAndDeliver(const Invocation& invocation, const CalibrateOptions& options,
                                 const client::Client& client) {
  const InterruptScope interrupt;
  TRUEPOSE_ASSIGN_OR_RETURN(std::optional<OutputFile> output, OpenOutput(options));
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::CalibrationJob created, CreateJob(client, options));
  if (options.preview) return ReplyPreview(invocation, created.preview());
  if (options.no_wait) return ReplyJob(invocation, created);
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::CalibrationJob job,
                            WaitWithProgress(invocation, client, created.name(), interrupt));
  TRUEPOSE_RETURN_IF_ERROR(StatusOfJob(job));
  v1::GetCalibrationRequest request;
  request.set_name(job.calibration());
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Calibration calibration, client.GetCalibration(request));
  const std::string name = ShortName(calibration.name());
  if (!invocation.json) invocation.console.out << "Calibration " << name << "\n";
  return Deliver(invocation, calibration, std::move(output),
                 absl::StrCat("truepose calibration approve ", name,
                              ", by somebody else than who measured; to try it: truepose "
                              "compensate TARGETS.csv --calibration ",
                              name, " --output corrected.csv"));
}

}  // namespace

absl::Status CalibrateOnServer(const Invocation& invocation, const CalibrateOptions& options) {
  TRUEPOSE_RETURN_IF_ERROR(CheckNames(options));
  return WithServer(invocation, kHint, [&](const client::Client& client) {
    return AsTyped(CalibrateAndDeliver(invocation, options, client), options);
  });
}

}  // namespace truepose::cli
