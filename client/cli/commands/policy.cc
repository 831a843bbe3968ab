// truepose policy set|list|delete: when the server asks for a recalibration by itself
#include <cmath>
#include <memory>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "client/cli/commands/commands.h"
#include "client/cli/commands/listed.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/table.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

using Policy = v1::RecalibrationPolicy;

constexpr char kHint[] = "`truepose policy list` shows the policies of this server.";
constexpr double kSecondsOfDay = 86'400.0;
// 300 years: what a duration of protobuf holds.
constexpr double kMostDays = 100'000.0;

struct Settings {
  std::string robot, name = "default", pose_set;
  double interval_days = 0.0, temperature_step_k = 0.0, expire_days = 0.0;
  std::vector<std::string> events;
  bool on_failed_check = false, dry_run = false;
  int poses = 0;
};

std::string PolicyName(const std::string& robot, const std::string& name) {
  return absl::StrCat(RobotName(robot), "/recalibrationPolicies/", name);
}

absl::Status SetDays(double days, const char* option, google::protobuf::Duration* duration) {
  if (!(days > 0.0 && days <= kMostDays))
    return OptionFault(option, absl::StrCat(days), "days, more than 0");
  duration->set_seconds(static_cast<int64_t>(std::llround(days * kSecondsOfDay)));
  return absl::OkStatus();
}

absl::Status AddEvents(const std::vector<std::string>& words, Policy& policy) {
  for (const std::string& word : words) {
    v1::RobotEventKind kind = v1::ROBOT_EVENT_KIND_UNSPECIFIED;
    std::string name = absl::AsciiStrToUpper(word);
    for (char& letter : name) letter = letter == '-' ? '_' : letter;
    if (!v1::RobotEventKind_Parse(name, &kind))
      return OptionFault("--event", word, "collision, motor-change, relocation or note");
    policy.add_event_kinds(kind);
  }
  return absl::OkStatus();
}

// A policy that never asks would replace one that does without a word.
absl::Status CheckAsks(const Settings& settings) {
  const bool asks = settings.interval_days != 0.0 || settings.temperature_step_k != 0.0 ||
                    !settings.events.empty() || settings.on_failed_check;
  if (asks) return absl::OkStatus();
  return UsageError(
      "found no cause, expected --interval-days, --temperature-step, --event or "
      "--on-failed-check; `truepose policy delete ROBOT` ends a policy");
}

absl::StatusOr<Policy> PolicyFrom(const Settings& settings) {
  TRUEPOSE_RETURN_IF_ERROR(CheckAsks(settings));
  Policy policy;
  policy.set_name(PolicyName(settings.robot, settings.name));
  if (settings.interval_days != 0.0)
    TRUEPOSE_RETURN_IF_ERROR(
        SetDays(settings.interval_days, "--interval-days", policy.mutable_interval()));
  if (settings.expire_days != 0.0)
    TRUEPOSE_RETURN_IF_ERROR(
        SetDays(settings.expire_days, "--expire-days", policy.mutable_expire_after()));
  TRUEPOSE_RETURN_IF_ERROR(AddEvents(settings.events, policy));
  policy.set_temperature_step_k(settings.temperature_step_k);
  policy.set_on_failed_check(settings.on_failed_check);
  policy.set_poses(settings.poses);
  if (!settings.pose_set.empty())
    policy.set_pose_set(absl::StrCat(RobotName(settings.robot), "/poseSets/", settings.pose_set));
  return policy;
}

std::string DaysText(bool given, const google::protobuf::Duration& duration) {
  if (!given) return "";
  return absl::StrCat(static_cast<double>(duration.seconds()) / kSecondsOfDay);
}

std::string PoliciesTable(const v1::ListRecalibrationPoliciesResponse& list) {
  if (list.recalibration_policies().empty())
    return "No policies. Next: truepose policy set ROBOT --interval-days 90\n";
  Table table({{"robot", Align::kLeft},
               {"policy", Align::kLeft},
               {"interval days"},
               {"step K"},
               {"events", Align::kLeft},
               {"failed check", Align::kLeft},
               {"expires days"}});
  for (const Policy& policy : list.recalibration_policies()) {
    std::vector<std::string> events;
    for (const int kind : policy.event_kinds())
      events.push_back(
          absl::AsciiStrToLower(v1::RobotEventKind_Name(static_cast<v1::RobotEventKind>(kind))));
    const double step_k = policy.temperature_step_k();
    table.Add({ShortName(RobotOf(policy.name())),
               policy.name().substr(policy.name().rfind('/') + 1),
               DaysText(policy.has_interval(), policy.interval()),
               step_k > 0.0 ? absl::StrCat(step_k) : "", absl::StrJoin(events, ", "),
               policy.on_failed_check() ? "yes" : "no",
               DaysText(policy.has_expire_after(), policy.expire_after())});
  }
  return table.Text();
}

std::string OneText(const Policy& policy) {
  v1::ListRecalibrationPoliciesResponse one;
  *one.add_recalibration_policies() = policy;
  return PoliciesTable(one);
}

// Makes the policy, or gives one that is there all the values of the command line.
absl::StatusOr<Policy> Put(const client::Client& client, const Settings& settings,
                           const Policy& policy) {
  v1::CreateRecalibrationPolicyRequest create;
  create.set_parent(RobotName(settings.robot));
  create.set_recalibration_policy_id(settings.name);
  create.set_validate_only(settings.dry_run);
  *create.mutable_recalibration_policy() = policy;
  absl::StatusOr<Policy> made = client.CreateRecalibrationPolicy(create);
  if (!absl::IsAlreadyExists(made.status())) return made;
  v1::UndeleteRecalibrationPolicyRequest undelete;
  undelete.set_name(policy.name());
  undelete.set_validate_only(settings.dry_run);
  TRUEPOSE_RETURN_IF_ERROR(client.UndeleteRecalibrationPolicy(undelete).status());
  v1::UpdateRecalibrationPolicyRequest update;
  update.set_validate_only(settings.dry_run);
  *update.mutable_recalibration_policy() = policy;
  return client.UpdateRecalibrationPolicy(update);
}

absl::Status Set(const Invocation& invocation, const Settings& settings) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Policy policy, PolicyFrom(settings));
  return WithServer(invocation, kRobotHint, [&](const client::Client& client) -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(const Policy stored, Put(client, settings, policy));
    return Reply(invocation, stored, [&] { return OneText(stored); });
  });
}

absl::Status Delete(const Invocation& invocation, const Settings& settings) {
  v1::DeleteRecalibrationPolicyRequest request;
  request.set_name(PolicyName(settings.robot, settings.name));
  return WithServer(invocation, kHint, [&](const client::Client& client) -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(const Policy policy, client.DeleteRecalibrationPolicy(request));
    return Reply(invocation, policy, [&] { return absl::StrCat("Deleted ", policy.name(), "\n"); });
  });
}

void AddSet(const Command& group) {
  const auto settings = std::make_shared<Settings>();
  group.Add("set", "Make a policy, or replace all values of one that is there")
      .Required("ROBOT", "", &settings->robot, "Such as ur10")
      .Option("--name", "NAME", &settings->name, "Of the policy; default: default")
      .Option("--interval-days", "DAYS", &settings->interval_days, "After the last activation")
      .Option("--temperature-step", "K", &settings->temperature_step_k,
              "Change since the active calibration's sessions")
      .Option("--event", "KIND", &settings->events, "collision, motor-change, relocation or note")
      .Option("--on-failed-check", "", &settings->on_failed_check,
              "A drift check beyond the robot's limit")
      .Option("--expire-days", "DAYS", &settings->expire_days,
              "After which a request that nobody has finished expires; default: 7")
      .Option("--dry-run", "", &settings->dry_run, "Only check it; nothing is stored")
      .Option("--pose-set", "NAME", &settings->pose_set,
              "Poses to measure; default: those of the active calibration, thinned")
      .Option("--poses", "N", &settings->poses, "How many poses a thinned set has; default: 20")
      .Footer(
          "Examples:\n  truepose policy set ur10 --interval-days 90 --on-failed-check\n"
          "  truepose policy set ur10 --event collision --event motor-change --temperature-step 5")
      .Run(Command::Reach::kRemote,
           [settings](const Invocation& invocation) { return Set(invocation, *settings); });
}

}  // namespace

void AddPolicy(const Command& root) {
  const Command group = root.Add("policy", "When the server asks for a recalibration by itself");
  group.Footer("Example:\n  truepose policy list --robot ur10");
  AddSet(group);
  const auto listed = std::make_shared<ListOptions>();
  const Command list = group.Add("list", "List the policies");
  AddListOptions(list, {.robot = true, .deleted = true, .example = "on_failed_check = true"},
                 listed.get());
  list.Footer("Examples:\n  truepose policy list\n  truepose policy list --robot ur10 --json")
      .Run(Command::Reach::kRemote, [listed](const Invocation& invocation) {
        return ReplyAllPages(invocation, *listed, &client::Client::ListRecalibrationPolicies,
                             PoliciesTable);
      });
  const auto settings = std::make_shared<Settings>();
  group.Add("delete", "Delete a policy; `set` brings it back")
      .Required("ROBOT", "", &settings->robot, "Such as ur10")
      .Option("--name", "NAME", &settings->name, "Of the policy; default: default")
      .Footer("Example:\n  truepose policy delete ur10")
      .Run(Command::Reach::kRemote,
           [settings](const Invocation& invocation) { return Delete(invocation, *settings); });
}

}  // namespace truepose::cli
