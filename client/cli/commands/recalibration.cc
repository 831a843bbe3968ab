// truepose recalibration request|list|acknowledge|measuring|calibrate|decline
#include <memory>

#include "absl/strings/ascii.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"
#include "client/cli/commands/commands.h"
#include "client/cli/commands/listed.h"
#include "client/cli/names.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/report.h"
#include "client/cli/table.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

using Request = v1::RecalibrationRequest;

constexpr char kHint[] = "`truepose recalibration list` shows the requests of this server.";
constexpr char kWhich[] = "Robot, whose open request is meant, or the request's whole name";

std::string Word(const std::string& name, absl::string_view prefix) {
  return absl::AsciiStrToLower(absl::StripPrefix(name, prefix));
}

std::string StateText(const Request& request) {
  return Word(v1::RecalibrationState_Name(request.state()), "REQUEST_");
}

std::string CauseText(const Request& request) {
  return Word(v1::RecalibrationCause_Name(request.cause()), "CAUSE_");
}

bool IsOpen(const Request& request) {
  return request.state() >= v1::REQUEST_PENDING && request.state() <= v1::REQUEST_CALIBRATING;
}

// What the next person or agent types.
std::string NextText(const Request& request) {
  const std::string robot = ShortName(RobotOf(request.name()));
  switch (request.state()) {
    case v1::REQUEST_PENDING:
      return absl::StrCat("Next: truepose recalibration acknowledge ", robot, "\n");
    case v1::REQUEST_ACKNOWLEDGED:
      return absl::StrCat("Next: truepose recalibration measuring ", robot, " --session UUID\n");
    case v1::REQUEST_MEASURING:
      return absl::StrCat("Next, when the session is sealed: truepose recalibration calibrate ",
                          robot, "\n");
    case v1::REQUEST_CALIBRATING:
      return absl::StrCat("Next: truepose job watch ", ShortName(request.job()), "\n");
    case v1::REQUEST_DONE:
      return absl::StrCat("Next: truepose calibration show ", ShortName(request.calibration()),
                          "\n");
    default:
      return "";
  }
}

std::string RequestText(const Request& request) {
  std::string text = absl::StrCat("Recalibration of ", ShortName(RobotOf(request.name())), ": ",
                                  StateText(request), "\n  name     ", request.name(),
                                  "\n  cause    ", CauseText(request), "\n");
  const auto add = [&](const char* title, const std::string& value) {
    if (!value.empty()) absl::StrAppend(&text, "  ", title, value, "\n");
  };
  add("reason   ", request.reason());
  add("by       ", request.created_by());
  add("poses    ", request.pose_set());
  add("session  ", ShortName(request.session()));
  if (request.readings_taken() > 0) add("readings ", absl::StrCat(request.readings_taken()));
  add("expires  ", IsOpen(request) ? TimeText(request.expire_time()) : "");
  for (const v1::RecalibrationStep& step : request.steps()) {
    absl::StrAppend(&text, "  ", TimeText(step.time()), " ",
                    Word(v1::RecalibrationState_Name(step.state()), "REQUEST_"), " by ",
                    step.principal(), step.reason().empty() ? "" : ": ", step.reason(), "\n");
  }
  return absl::StrCat(text, NextText(request));
}

// The name of the request that is meant.
absl::StatusOr<std::string> Meant(const client::Client& client, const std::string& typed) {
  if (absl::StrContains(typed, "/recalibrationRequests/")) return typed;
  ListOptions of_robot;
  of_robot.robot = typed;
  TRUEPOSE_ASSIGN_OR_RETURN(const auto all,
                            AllPages(client, of_robot, &client::Client::ListRecalibrationRequests));
  for (const Request& request : all.recalibration_requests())
    if (IsOpen(request)) return request.name();
  return absl::NotFoundError(absl::StrCat(RobotName(typed), " has no open request"));
}

std::string RequestsTable(const v1::ListRecalibrationRequestsResponse& list) {
  if (list.recalibration_requests().empty())
    return "No requests. Next: truepose recalibration request ROBOT --reason TEXT\n";
  Table table({{"robot", Align::kLeft},
               {"state", Align::kLeft},
               {"cause", Align::kLeft},
               {"reason", Align::kLeft},
               {"raised", Align::kLeft},
               {"result", Align::kLeft}});
  for (const Request& request : list.recalibration_requests()) {
    table.Add({ShortName(RobotOf(request.name())), StateText(request), CauseText(request),
               request.reason(), TimeText(request.create_time()),
               ShortName(request.calibration())});
  }
  return table.Text();
}

struct Asked {
  std::string robot, reason, calibrate, pose_set;
  bool dry_run = false;
};

absl::Status Ask(const Invocation& invocation, const Asked& asked) {
  v1::CreateRecalibrationRequestRequest request;
  request.set_parent(RobotName(asked.robot));
  request.set_recalibration_request_id(RandomUuid());
  request.set_validate_only(asked.dry_run);
  Request& content = *request.mutable_recalibration_request();
  content.set_reason(asked.reason);
  content.set_calibrate(asked.calibrate);
  if (!asked.pose_set.empty()) {
    content.set_pose_set(absl::StrContains(asked.pose_set, "/")
                             ? asked.pose_set
                             : absl::StrCat(request.parent(), "/poseSets/", asked.pose_set));
  }
  return WithServer(invocation, kRobotHint, [&](const client::Client& client) -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(const Request made, client.CreateRecalibrationRequest(request));
    return Reply(invocation, made, [&] { return RequestText(made); });
  });
}

// One step of the request that is meant; `call` fills in nothing but the name.
template <typename StepRequest>
absl::Status Step(const Invocation& invocation, const std::string& typed, StepRequest request,
                  absl::StatusOr<Request> (client::Client::*call)(const StepRequest&) const) {
  return WithServer(invocation, kHint, [&](const client::Client& client) -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(*request.mutable_name(), Meant(client, typed));
    TRUEPOSE_ASSIGN_OR_RETURN(const Request changed, (client.*call)(request));
    return Reply(invocation, changed, [&] { return RequestText(changed); });
  });
}

void AddRequest(const Command& group) {
  const auto asked = std::make_shared<Asked>();
  group.Add("request", "Ask for the recalibration of a robot")
      .Required("ROBOT", "", &asked->robot, "Such as ur10")
      .Option("--reason", "TEXT", &asked->reason, "Why, for those who measure")
      .Option("--calibrate", "PART", &asked->calibrate,
              "all, internal, external, or names of parameters with commas; default: all")
      .Option("--dry-run", "", &asked->dry_run, "Only check it; nothing is raised")
      .Option("--pose-set", "NAME", &asked->pose_set,
              "Poses to measure; default: those of the active calibration, thinned")
      .Footer(
          "Examples:\n  truepose recalibration request ur10 --reason 'it hit the fixture'\n"
          "  truepose recalibration request ur10 --calibrate dq3 --pose-set short")
      .Run(Command::Reach::kRemote,
           [asked](const Invocation& invocation) { return Ask(invocation, *asked); });
}

void AddAcknowledge(const Command& group) {
  const auto name = std::make_shared<std::string>();
  group.Add("acknowledge", "Take a request on")
      .Required("ROBOT", "", name.get(), kWhich)
      .Footer("Example:\n  truepose recalibration acknowledge ur10")
      .Run(Command::Reach::kRemote, [name](const Invocation& invocation) {
        return Step(invocation, *name, v1::AcknowledgeRecalibrationRequest(),
                    &client::Client::AcknowledgeRecalibration);
      });
}

struct Measured {
  std::string name, session;
  int readings = 0;
};

void AddMeasuring(const Command& group) {
  const auto measured = std::make_shared<Measured>();
  group.Add("measuring", "Say into which session readings are taken, and how many there are")
      .Required("ROBOT", "", &measured->name, kWhich)
      .Option("--session", "UUID", &measured->session, "Default: the one named before")
      .Option("--readings", "N", &measured->readings, "Readings taken so far")
      .Footer(
          "Example:\n  truepose recalibration measuring ur10 --session "
          "5f0c2c1e-8a53-4f0e-9a51-6f1f0f1f7a11 --readings 12")
      .Run(Command::Reach::kRemote, [measured](const Invocation& invocation) {
        v1::ReportMeasuringRequest request;
        request.set_session(SessionName(measured->session));
        request.set_readings_taken(measured->readings);
        return Step(invocation, measured->name, request, &client::Client::ReportMeasuring);
      });
}

void AddCalibrateFor(const Command& group) {
  const auto name = std::make_shared<std::string>();
  const auto split = std::make_shared<std::string>();
  group.Add("calibrate", "Calibrate from the sealed session of a request")
      .Required("ROBOT", "", name.get(), kWhich)
      .Option("--split", "RULE", split.get(),
              "Which readings identify, as of `truepose calibrate`; default: random:1:0.75")
      .Footer(
          "Examples:\n  truepose recalibration calibrate ur10\n"
          "  truepose recalibration calibrate ur10 --split even-odd")
      .Run(Command::Reach::kRemote, [name, split](const Invocation& invocation) {
        v1::CalibrateForRequestRequest request;
        request.set_split(*split);
        return Step(invocation, *name, request, &client::Client::CalibrateForRequest);
      });
}

void AddDecline(const Command& group) {
  const auto name = std::make_shared<std::string>();
  const auto reason = std::make_shared<std::string>();
  group.Add("decline", "End a request without recalibrating")
      .Required("ROBOT", "", name.get(), kWhich)
      .Required("--reason", "TEXT", reason.get(), "Why not")
      .Footer("Example:\n  truepose recalibration decline ur10 --reason 'replaced next week'")
      .Run(Command::Reach::kRemote, [name, reason](const Invocation& invocation) {
        v1::DeclineRecalibrationRequest request;
        request.set_reason(*reason);
        return Step(invocation, *name, request, &client::Client::DeclineRecalibration);
      });
}

}  // namespace

void AddRecalibration(const Command& root) {
  const Command group = root.Add("recalibration", "Requests to recalibrate a robot");
  group.Footer("Example:\n  truepose recalibration list --robot ur10");
  AddRequest(group);
  const auto listed = std::make_shared<ListOptions>();
  const Command list = group.Add("list", "List the requests, oldest first");
  AddListOptions(list, {.robot = true, .deleted = false, .example = "state = \"REQUEST_PENDING\""},
                 listed.get());
  list.Footer(
          "Examples:\n  truepose recalibration list\n"
          "  truepose recalibration list --robot ur10 --json")
      .Run(Command::Reach::kRemote, [listed](const Invocation& invocation) {
        return ReplyAllPages(invocation, *listed, &client::Client::ListRecalibrationRequests,
                             RequestsTable);
      });
  AddAcknowledge(group);
  AddMeasuring(group);
  AddCalibrateFor(group);
  AddDecline(group);
}

}  // namespace truepose::cli
