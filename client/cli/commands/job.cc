// truepose job watch|list|cancel
#include <memory>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_replace.h"
#include "client/cli/commands/commands.h"
#include "client/cli/commands/list_options.h"
#include "client/cli/commands/wait.h"
#include "client/cli/names.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/report.h"
#include "client/cli/table.h"
#include "client/pager.h"
#include "client/wait_for_job.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

std::string StateText(const v1::CalibrationJob& job) {
  return absl::AsciiStrToLower(v1::JobState_Name(job.state()));
}

// Of a job that has built a table.
std::string TableJobText(const v1::CalibrationJob& job, const std::string& text) {
  const std::string table =
      absl::StrReplaceAll(job.compensation_table(), {{"robots/", ""}, {"compensationTables/", ""}});
  return absl::StrCat(text, ", table ", table, " of ", ShortName(job.calibration()),
                      "\nNext: truepose table download ", table, " --output table.tpct\n");
}

std::string JobText(const v1::CalibrationJob& job) {
  std::string text = absl::StrCat("Job ", ShortName(job.name()), " of ", ShortName(job.robot()),
                                  ": ", StateText(job));
  if (job.cancel_requested() && job.state() == v1::RUNNING)
    absl::StrAppend(&text, ", cancel requested");
  if (job.state() == v1::SUCCEEDED && !job.compensation_table().empty())
    return TableJobText(job, text);
  if (job.calibration().empty()) return absl::StrCat(text, "\n");
  const std::string calibration = ShortName(job.calibration());
  return absl::StrCat(text, ", calibration ", calibration, "\nNext: truepose calibration show ",
                      calibration, "\n");
}

// The exit code tells how the job ended, also when it ended long ago. The look before the wait
// tells at once when there is no such job or no server; only a server that has answered is waited
// for.
absl::Status Watch(const Invocation& invocation, const std::string& name) {
  return WithServer(invocation, kJobHint, [&](const client::Client& client) -> absl::Status {
    v1::GetCalibrationJobRequest request;
    request.set_name(JobName(name));
    TRUEPOSE_ASSIGN_OR_RETURN(v1::CalibrationJob job, client.GetCalibrationJob(request));
    if (!client::IsTerminal(job.state())) {
      const InterruptScope interrupt;
      TRUEPOSE_ASSIGN_OR_RETURN(job, WaitWithProgress(invocation, client, job.name(), interrupt));
    }
    TRUEPOSE_RETURN_IF_ERROR(StatusOfJob(job));
    return Reply(invocation, job, [&] { return JobText(job); });
  });
}

std::string JobsTable(const v1::ListCalibrationJobsResponse& list) {
  if (list.jobs().empty()) return "No jobs. Next: truepose calibrate --robot NAME --session UUID\n";
  Table table({{"job", Align::kLeft},
               {"robot", Align::kLeft},
               {"state", Align::kLeft},
               {"done"},
               {"makes", Align::kLeft},
               {"calibration", Align::kLeft},
               {"created", Align::kLeft}});
  for (const v1::CalibrationJob& job : list.jobs()) {
    const double fraction = job.state() == v1::SUCCEEDED ? 1.0 : job.progress().fraction();
    table.Add({ShortName(job.name()), ShortName(job.robot()), StateText(job),
               absl::StrFormat("%.0f %%", 100.0 * fraction),
               job.compensation_table().empty() ? "calibration" : "table",
               ShortName(job.calibration()), TimeText(job.create_time())});
  }
  return table.Text();
}

absl::Status List(const Invocation& invocation, const ListOptions& options) {
  return WithServer(invocation, kRobotHint, [&](const client::Client& client) -> absl::Status {
    v1::ListCalibrationJobsRequest first;
    first.set_robot(RobotName(options.robot));
    SetListOptions(options, first);
    v1::ListCalibrationJobsResponse all;
    TRUEPOSE_RETURN_IF_ERROR(AsListed(client::ForEachPage(
        first, [&](const auto& request) { return client.ListCalibrationJobs(request); },
        [&](const v1::ListCalibrationJobsResponse& page) {
          all.MergeFrom(page);
          return absl::OkStatus();
        })));
    all.clear_next_page_token();
    return Reply(invocation, all, [&] { return JobsTable(all); });
  });
}

absl::Status Cancel(const Invocation& invocation, const std::string& name) {
  return WithServer(invocation, kJobHint, [&](const client::Client& client) -> absl::Status {
    v1::CancelCalibrationJobRequest request;
    request.set_name(JobName(name));
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::CalibrationJob job, client.CancelCalibrationJob(request));
    return Reply(invocation, job, [&] { return JobText(job); });
  });
}

void AddOne(const Command& job, const std::string& verb, const std::string& summary,
            absl::Status (*act)(const Invocation&, const std::string&)) {
  const auto name = std::make_shared<std::string>();
  job.Add(verb, summary)
      .Required("JOB", "", name.get(), "UUID")
      .Footer(
          absl::StrCat("Example:\n  truepose job ", verb, " 0d5a9e1c-52a8-4d6c-8f0a-3a1f1a6a8f11"))
      .Run(Command::Reach::kRemote,
           [=](const Invocation& invocation) { return act(invocation, *name); });
}

}  // namespace

void AddJob(const Command& root) {
  const Command job = root.Add("job", "Jobs on the server: calibrations and tables");
  job.Footer("Example:\n  truepose job list --robot ur10");
  AddOne(job, "watch", "Wait for a job; its end is the exit code", Watch);
  AddOne(job, "cancel", "End a job", Cancel);
  const auto options = std::make_shared<ListOptions>();
  const Command list = job.Add("list", "List the jobs");
  AddListOptions(list, {.robot = true, .example = "state = \"FAILED\""}, options.get());
  list.Footer(
          "Examples:\n  truepose job list\n"
          "  truepose job list --robot ur10 --filter 'state = \"FAILED\"' --json")
      .Run(Command::Reach::kRemote,
           [options](const Invocation& invocation) { return List(invocation, *options); });
}

}  // namespace truepose::cli
