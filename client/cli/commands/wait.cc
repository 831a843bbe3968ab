#include "client/cli/commands/wait.h"

#include "absl/strings/str_cat.h"
#include "client/cli/commands/calibrate.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "client/cli/progress.h"
#include "client/wait_for_job.h"
#include "core/base/fault.h"

namespace truepose::cli {
namespace {

std::string StillRunningHint(const std::string& job) {
  return absl::StrCat("Job ", job, " goes on without us: `truepose job watch ", job,
                      "` waits for it, `truepose job cancel ", job, "` ends it.");
}

absl::StatusOr<v1::CalibrationJob> Wait(const Invocation& invocation, const client::Client& client,
                                        const std::string& job, const InterruptScope& interrupt,
                                        const std::string& label) {
  ProgressBar bar(invocation.console, label);
  client::WaitOptions options;
  options.on_change = [&](const v1::CalibrationJob& now) {
    bar.Show(now.progress().fraction(),
             now.state() == v1::PENDING ? "waiting for a worker" : StageText(now.progress()));
  };
  options.is_cancelled = [&] { return interrupt.interrupted(); };
  return client::WaitForJob(client, job, options);
}

// What the run says of its input keeps its code. Any other failure is the job's: codes such as
// UNAVAILABLE would send people to look for a server that is there.
absl::StatusCode CodeOf(const v1::JobError& error) {
  const auto code = static_cast<absl::StatusCode>(error.code());
  switch (code) {
    case absl::StatusCode::kInvalidArgument:
    case absl::StatusCode::kFailedPrecondition:
    case absl::StatusCode::kCancelled:
    case absl::StatusCode::kInternal:
      return code;
    default:
      return absl::StatusCode::kAborted;
  }
}

absl::Status StatusOfError(const v1::JobError& error) {
  FaultList faults;
  for (const v1::Fault& fault : error.faults())
    faults.Add(fault.field(), fault.found(), fault.expected());
  if (!faults.empty()) return AsFaultOfInput(faults.ToStatus(CodeOf(error)));
  return absl::Status(CodeOf(error), error.message());
}

}  // namespace

absl::StatusOr<v1::CalibrationJob> WaitWithProgress(const Invocation& invocation,
                                                    const client::Client& client,
                                                    const std::string& job,
                                                    const InterruptScope& interrupt,
                                                    const std::string& label) {
  absl::StatusOr<v1::CalibrationJob> ended = Wait(invocation, client, job, interrupt, label);
  const absl::StatusCode code = ended.status().code();
  if (code != absl::StatusCode::kCancelled && code != absl::StatusCode::kUnavailable) return ended;
  return WithHint(ended.status(), code, StillRunningHint(ShortName(job)));
}

absl::Status StatusOfJob(const v1::CalibrationJob& job) {
  if (job.state() == v1::SUCCEEDED) return absl::OkStatus();
  if (job.state() == v1::FAILED) return StatusOfError(job.error());
  return absl::CancelledError(absl::StrCat("job ", ShortName(job.name()), " was cancelled"));
}

}  // namespace truepose::cli
