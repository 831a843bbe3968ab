// truepose drift check|list: whether a robot is still as it was calibrated
#include <memory>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "client/cli/commands/commands.h"
#include "client/cli/commands/listed.h"
#include "client/cli/names.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/report.h"
#include "client/cli/table.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

using Check = v1::DriftCheck;

constexpr char kHint[] =
    "`truepose robot list` and `truepose session list` show what this server has.";

std::string PartsTable(const Check& check) {
  Table table({{"part", Align::kLeft}, {"chi-square"}, {"dof"}, {"p"}, {"mm"}, {"deg"}});
  for (const v1::DriftPart& part : check.parts()) {
    table.Add({part.part(), Fixed(part.chi_square(), 1), absl::StrCat(part.degrees_of_freedom()),
               absl::StrFormat("%.2g", part.p_value()), Fixed(part.change_mm(), 3),
               Fixed(part.change_deg(), 4)});
  }
  return table.empty() ? "" : table.Text("  ");
}

std::string LimitText(const Check& check) {
  if (check.limit_mm() <= 0.0) return "";
  return absl::StrCat(", limit ", Fixed(check.limit_mm(), 3),
                      check.limit_exceeded() ? " mm EXCEEDED" : " mm");
}

std::string CheckText(const Check& check) {
  std::string text = absl::StrCat(
      "Drift check of ", ShortName(check.calibration()), " with ", Count(check.poses(), "pose"),
      ": ", check.changed() ? "the robot has changed" : "no change found", "\n  position RMS ",
      Fixed(check.position_mm().rms(), 3), " mm, max ", Fixed(check.position_mm().max(), 3), " mm",
      LimitText(check), "\n  chi-square ", Fixed(check.chi_square(), 1), " with ",
      check.degrees_of_freedom(), " degrees of freedom, p ",
      absl::StrFormat("%.2g", check.p_value()), "\n");
  if (!check.attributed_to().empty())
    absl::StrAppend(&text, "  points to ", check.attributed_to(), "\n");
  for (const std::string& finding : check.findings()) absl::StrAppend(&text, "  ", finding, "\n");
  absl::StrAppend(&text, PartsTable(check));
  if (!check.recalibration_request().empty()) {
    absl::StrAppend(&text, "Next, of the request that it raised: truepose recalibration ",
                    "acknowledge ", ShortName(RobotOf(check.name())), "\n");
  }
  return text;
}

absl::Status RunCheck(const Invocation& invocation, const std::string& robot,
                      const std::string& session) {
  v1::CreateDriftCheckRequest request;
  request.set_parent(RobotName(robot));
  request.set_drift_check_id(RandomUuid());
  request.mutable_drift_check()->set_session(SessionName(session));
  return WithServer(invocation, kHint, [&](const client::Client& client) -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(const Check check, client.CreateDriftCheck(request));
    return Reply(invocation, check, [&] { return CheckText(check); });
  });
}

std::string ChecksTable(const v1::ListDriftChecksResponse& list) {
  if (list.drift_checks().empty()) return "No checks. Next: truepose drift check ROBOT SESSION\n";
  Table table({{"robot", Align::kLeft},
               {"calibration", Align::kLeft},
               {"poses"},
               {"rms mm"},
               {"changed", Align::kLeft},
               {"points to", Align::kLeft},
               {"checked", Align::kLeft}});
  for (const Check& check : list.drift_checks()) {
    table.Add({ShortName(RobotOf(check.name())), ShortName(check.calibration()),
               absl::StrCat(check.poses()), Fixed(check.position_mm().rms(), 3),
               check.changed() ? "yes" : "no", check.attributed_to(),
               TimeText(check.create_time())});
  }
  return table.Text();
}

}  // namespace

void AddDrift(const Command& root) {
  const Command group = root.Add("drift", "Whether a robot is still as it was calibrated");
  group.Footer("Example:\n  truepose drift list --robot ur10");
  const auto robot = std::make_shared<std::string>();
  const auto session = std::make_shared<std::string>();
  group.Add("check", "Check a sealed session against the active calibration")
      .Required("ROBOT", "", robot.get(), "Such as ur10")
      .Required("SESSION", "", session.get(), "UUID of a sealed session of about 20 poses")
      .Footer("Example:\n  truepose drift check ur10 5f0c2c1e-8a53-4f0e-9a51-6f1f0f1f7a11")
      .Run(Command::Reach::kRemote, [robot, session](const Invocation& invocation) {
        return RunCheck(invocation, *robot, *session);
      });
  const auto listed = std::make_shared<ListOptions>();
  const Command list = group.Add("list", "List the checks, oldest first");
  AddListOptions(list, {.robot = true, .deleted = false, .example = "changed = true"},
                 listed.get());
  list.Footer("Examples:\n  truepose drift list\n  truepose drift list --robot ur10 --json")
      .Run(Command::Reach::kRemote, [listed](const Invocation& invocation) {
        return ReplyAllPages(invocation, *listed, &client::Client::ListDriftChecks, ChecksTable);
      });
}

}  // namespace truepose::cli
