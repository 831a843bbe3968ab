// truepose calibration list|show; the others are files of their own
#include <memory>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "client/cli/commands/commands.h"
#include "client/cli/commands/download.h"
#include "client/cli/commands/list_options.h"
#include "client/cli/json.h"
#include "client/cli/names.h"
#include "client/cli/output_file.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/report.h"
#include "client/cli/table.h"
#include "client/pager.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

// The control set speaks where there is one.
const v1::SetReport& JudgingSet(const v1::Sets& sets) {
  return sets.control().poses() > 0 ? sets.control() : sets.complete();
}

// "all", or of a partial one what was found anew and from which: "dq3 from ur10#1".
std::string PartText(const v1::CalibrationOptions& options) {
  const std::string part = options.calibrate().empty() ? "all" : options.calibrate();
  if (options.prior() != "calibration") return part;
  const std::string& prior = options.prior_calibration().name();
  return absl::StrCat(part, " from ", prior.empty() ? "a file" : ShortName(prior));
}

std::string CalibrationsTable(const v1::ListCalibrationsResponse& list) {
  if (list.calibrations().empty())
    return "No calibrations. Next: truepose calibrate --robot NAME --session UUID\n";
  Table table({{"calibration", Align::kLeft},
               {"calibrated", Align::kLeft},
               {"split", Align::kLeft},
               {"rows"},
               {"rms mm before"},
               {"after"},
               {"verdict", Align::kLeft},
               {"state", Align::kLeft},
               {"created", Align::kLeft}});
  for (const v1::Calibration& calibration : list.calibrations()) {
    const v1::CalibrationReport& report = calibration.report();
    const v1::SetReport& set = JudgingSet(report.sets());
    table.Add({ShortName(calibration.name()), PartText(calibration.options()),
               report.split().empty() ? "none" : report.split(), absl::StrCat(set.poses()),
               Fixed(set.before().position_mm().rms(), 3),
               Fixed(set.after().position_mm().rms(), 3),
               absl::StrReplaceAll(report.verdict(), {{"_", " "}}),
               absl::AsciiStrToLower(v1::ReleaseState_Name(calibration.state())),
               TimeText(calibration.create_time())});
  }
  return table.Text();
}

absl::Status AppendCalibrationsOf(const client::Client& client, const std::string& robot,
                                  const ListOptions& options, v1::ListCalibrationsResponse* all) {
  v1::ListCalibrationsRequest first;
  first.set_robot(robot);
  SetListOptions(options, first);
  return client::ForEachPage(
      first, [&](const auto& request) { return client.ListCalibrations(request); },
      [&](const v1::ListCalibrationsResponse& page) {
        all->MergeFrom(page);
        return absl::OkStatus();
      });
}

// The service lists calibrations by robot.
absl::Status AppendAllCalibrations(const client::Client& client, const ListOptions& options,
                                   v1::ListCalibrationsResponse* all) {
  return client::ForEachPage(
      v1::ListRobotsRequest(), [&](const auto& request) { return client.ListRobots(request); },
      [&](const v1::ListRobotsResponse& page) {
        for (const v1::Robot& robot : page.robots()) {
          TRUEPOSE_RETURN_IF_ERROR(AppendCalibrationsOf(client, robot.name(), options, all));
        }
        return absl::OkStatus();
      });
}

absl::Status List(const Invocation& invocation, const ListOptions& options) {
  return WithServer(invocation, kRobotHint, [&](const client::Client& client) -> absl::Status {
    v1::ListCalibrationsResponse all;
    TRUEPOSE_RETURN_IF_ERROR(
        AsListed(options.robot.empty()
                     ? AppendAllCalibrations(client, options, &all)
                     : AppendCalibrationsOf(client, RobotName(options.robot), options, &all)));
    all.clear_next_page_token();
    return Reply(invocation, all, [&] { return CalibrationsTable(all); });
  });
}

std::string HeadText(const v1::Calibration& calibration) {
  std::string text = absl::StrCat(
      "Calibration ", ShortName(calibration.name()), " of ", TimeText(calibration.create_time()),
      "\n  nominal ", calibration.nominal_revision(), ", job ", ShortName(calibration.job()),
      "\n  SHA-256 ", calibration.digest(), "\n");
  for (const std::string& session : calibration.sessions()) {
    absl::StrAppend(&text, "  session ", ShortName(session), "\n");
  }
  return absl::StrCat(text, "\n");
}

absl::Status Write(const v1::Calibration& calibration, const std::string& path) {
  if (path.empty()) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string json, ToJson(calibration, /*pretty=*/true));
  TRUEPOSE_ASSIGN_OR_RETURN(OutputFile file, OutputFile::Create(path, "--output"));
  return file.Commit(json);
}

absl::Status Show(const Invocation& invocation, const std::string& typed,
                  const std::string& output) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string name, CalibrationName(typed));
  return WithServer(
      invocation, kCalibrationHint, [&](const client::Client& client) -> absl::Status {
        TRUEPOSE_ASSIGN_OR_RETURN(const auto calibration,
                                  DownloadWhole<v1::Calibration>(invocation, client, name));
        TRUEPOSE_RETURN_IF_ERROR(Write(calibration, output));
        return Reply(invocation, calibration, [&] {
          return absl::StrCat(HeadText(calibration),
                              CalibrationText(calibration, invocation.console));
        });
      });
}

}  // namespace

void AddCalibration(const Command& root) {
  const Command calibration = root.Add("calibration", "Results of calibration jobs");
  calibration.Footer("Example:\n  truepose calibration list --robot ur10");
  const auto options = std::make_shared<ListOptions>();
  const Command list = calibration.Add("list", "List the calibrations");
  AddListOptions(list, {.robot = true, .example = "state = \"ACTIVE\""}, options.get());
  list.Footer(
          "Examples:\n  truepose calibration list\n"
          "  truepose calibration list --robot ur10 --filter 'state = \"ACTIVE\"' --json")
      .Run(Command::Reach::kRemote,
           [options](const Invocation& invocation) { return List(invocation, *options); });
  const auto name = std::make_shared<std::string>();
  const auto output = std::make_shared<std::string>();
  calibration.Add("show", "Show one calibration")
      .Required("CALIBRATION", "", name.get(), "Such as ur10#1")
      .Option("--output", "FILE", output.get(), "Also write it as JSON, for --local commands")
      .Footer(
          "Examples:\n  truepose calibration show ur10#1\n"
          "  truepose calibration show ur10#1 --output ur10.calibration.json")
      .Run(Command::Reach::kRemote,
           [=](const Invocation& invocation) { return Show(invocation, *name, *output); });
  AddCalibrationRelease(calibration);
  AddCalibrationCompare(calibration);
  AddCalibrationExport(calibration);
  AddCalibrationConvert(calibration);
}

}  // namespace truepose::cli
