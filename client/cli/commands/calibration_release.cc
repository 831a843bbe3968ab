// truepose calibration approve|reject|activate|rollback|history: a calibration's way to the robot.
#include <functional>
#include <memory>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "client/cli/commands/commands.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/report.h"
#include "client/cli/table.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

struct Options {
  std::string name;  // of a calibration; of the robot to roll back
  std::string reason, etag, from;
  bool dry_run = false;
};

std::string StateText(v1::ReleaseState state) {
  return absl::AsciiStrToLower(v1::ReleaseState_Name(state));
}

std::string HistoryText(const v1::Calibration& calibration) {
  Table table({{"time", Align::kLeft},
               {"state", Align::kLeft},
               {"by", Align::kLeft},
               {"reason", Align::kLeft}});
  for (const v1::ReleaseStep& step : calibration.release_steps()) {
    table.Add({TimeText(step.time()), StateText(step.state()), step.principal(), step.reason()});
  }
  return table.Text("  ");
}

std::string NextText(const v1::Calibration& calibration) {
  const std::string name = ShortName(calibration.name());
  switch (calibration.state()) {
    case v1::DRAFT:
      return absl::StrCat("Next: truepose calibration approve ", name, "\n");
    case v1::APPROVED:
      return absl::StrCat("Next: truepose calibration activate ", name, "\n");
    case v1::ACTIVE:
      return absl::StrCat("Next: truepose compensate TARGETS.csv --calibration ", name,
                          " --output corrected.csv\n");
    default:
      return "";
  }
}

std::string ReleaseText(const v1::Calibration& calibration) {
  return absl::StrCat("Calibration ", ShortName(calibration.name()), ": ",
                      StateText(calibration.state()), ", of job ", ShortName(calibration.job()),
                      "\n", HistoryText(calibration), NextText(calibration));
}

// What a person may do whom the server refuses.
absl::Status WithReleaseHints(const absl::Status& status) {
  const absl::Status denied = WithHint(
      RenameFields(status, {{"etag", "--etag"}, {"reason", "--reason"}, {"from", "--from"}}),
      absl::StatusCode::kPermissionDenied,
      "A second person has to do it, with a person's token. An admin may set the robot's "
      "release_policy.");
  return WithHint(denied, absl::StatusCode::kFailedPrecondition,
                  "`truepose calibration history NAME` shows how far it is.");
}

// Of a robot with a table_spec a table follows; a robot that can't be read has said nothing of one.
std::string TableThatFollows(const client::Client& client, const v1::Calibration& calibration) {
  if (calibration.state() != v1::ACTIVE) return "";
  v1::GetRobotRequest request;
  request.set_name(RobotOf(calibration.name()));
  const auto robot = client.GetRobot(request);
  if (!robot.ok() || !robot->has_table_spec()) return "";
  return absl::StrCat("A table of it is built, by the robot's table_spec. How far it is: truepose ",
                      "table list --robot ", ShortName(robot->name()), "\n");
}

using Ask = std::function<absl::StatusOr<v1::Calibration>(const client::Client&)>;
// What is said below the calibration.
using Tell = std::function<std::string(const client::Client&, const v1::Calibration&)>;

absl::Status AskAndReply(const Invocation& invocation, const char* hint, const Ask& ask,
                         const Tell& tell) {
  return WithServer(invocation, hint, [&](const client::Client& client) -> absl::Status {
    const absl::StatusOr<v1::Calibration> calibration = ask(client);
    if (!calibration.ok()) return WithReleaseHints(calibration.status());
    return Reply(invocation, *calibration, [&] {
      return absl::StrCat(ReleaseText(*calibration), tell(client, *calibration));
    });
  });
}

Tell AfterStep(bool dry_run) {
  if (!dry_run) return TableThatFollows;
  return [](const auto&, const auto&) { return "Dry run: nothing was changed.\n"; };
}

// Approve, reject and activate have requests of the same form.
template <typename Request>
absl::Status Release(const Invocation& invocation, const Options& options,
                     absl::StatusOr<v1::Calibration> (client::Client::*method)(const Request&)
                         const) {
  Request request;
  TRUEPOSE_ASSIGN_OR_RETURN(*request.mutable_name(), CalibrationName(options.name));
  request.set_reason(options.reason);
  request.set_etag(options.etag);
  request.set_validate_only(options.dry_run);
  return AskAndReply(
      invocation, kCalibrationHint,
      [&](const client::Client& client) { return (client.*method)(request); },
      AfterStep(options.dry_run));
}

absl::Status RollBack(const Invocation& invocation, const Options& options) {
  v1::RollBackCalibrationRequest request;
  request.set_robot(RobotName(options.name));
  request.set_reason(options.reason);
  request.set_validate_only(options.dry_run);
  if (!options.from.empty()) {
    TRUEPOSE_ASSIGN_OR_RETURN(*request.mutable_from(), CalibrationName(options.from));
  }
  return AskAndReply(
      invocation, kRobotHint,
      [&](const client::Client& client) { return client.RollBackCalibration(request); },
      AfterStep(options.dry_run));
}

absl::Status History(const Invocation& invocation, const Options& options) {
  v1::GetCalibrationRequest request;
  TRUEPOSE_ASSIGN_OR_RETURN(*request.mutable_name(), CalibrationName(options.name));
  return AskAndReply(
      invocation, kCalibrationHint,
      [&](const client::Client& client) { return client.GetCalibration(request); },
      [](const auto&, const auto&) { return ""; });
}

void AddReasonAndDryRun(const Command& command, Options* options) {
  command.Option("--reason", "TEXT", &options->reason, "Why, for those who come after")
      .Option("--dry-run", "", &options->dry_run,
              "Only say whether it would be done; nothing is changed");
}

template <typename Request>
void AddStep(const Command& calibration, const std::string& verb, const std::string& summary,
             absl::StatusOr<v1::Calibration> (client::Client::*method)(const Request&) const,
             const std::string& example) {
  const auto options = std::make_shared<Options>();
  const Command command = calibration.Add(verb, summary);
  command.Required("CALIBRATION", "", &options->name, "Such as ur10#1")
      .Option("--etag", "ETAG", &options->etag,
              "Only if it is still in this state (of --json); default: whatever state");
  AddReasonAndDryRun(command, options.get());
  command.Footer(absl::StrCat("Example:\n  truepose calibration ", verb, " ur10#1", example))
      .Run(Command::Reach::kRemote, [options, method](const Invocation& invocation) {
        return Release(invocation, *options, method);
      });
}

void AddRollBack(const Command& calibration) {
  const auto options = std::make_shared<Options>();
  const Command command = calibration.Add("rollback", "Go back to the calibration before");
  command.Required("ROBOT", "", &options->name, "Such as ur10")
      .Option("--from", "CALIBRATION", &options->from,
              "Only if this one is active; default: whichever is");
  AddReasonAndDryRun(command, options.get());
  command
      .Footer(
          "Examples:\n  truepose calibration rollback ur10 --reason 'collision after the change'\n"
          "  truepose calibration rollback ur10 --from ur10#3")
      .Run(Command::Reach::kRemote,
           [options](const Invocation& invocation) { return RollBack(invocation, *options); });
}

void AddHistory(const Command& calibration) {
  const auto options = std::make_shared<Options>();
  calibration.Add("history", "Who released a calibration, when and why")
      .Required("CALIBRATION", "", &options->name, "Such as ur10#1")
      .Footer("Example:\n  truepose calibration history ur10#1")
      .Run(Command::Reach::kRemote,
           [options](const Invocation& invocation) { return History(invocation, *options); });
}

}  // namespace

void AddCalibrationRelease(const Command& calibration) {
  AddStep(calibration, "approve", "Find a draft good: the second person's step",
          &client::Client::ApproveCalibration, "");
  AddStep(calibration, "reject", "Never use it", &client::Client::RejectCalibration,
          " --reason 'loose target'");
  AddStep(calibration, "activate", "Let an approved one act on its robot",
          &client::Client::ActivateCalibration, "");
  AddRollBack(calibration);
  AddHistory(calibration);
}

}  // namespace truepose::cli
