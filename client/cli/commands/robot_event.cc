// truepose robot-event add|list: what happened to a robot
#include <memory>

#include "absl/strings/ascii.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/time/time.h"
#include "client/cli/commands/commands.h"
#include "client/cli/commands/listed.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/report.h"
#include "client/cli/table.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

using Event = v1::RobotEvent;

struct Told {
  std::string robot, kind, time, description, temperature_c;
  int joint = 0;
  bool dry_run = false;
};

absl::Status SetKind(const std::string& word, Event& event) {
  std::string name = absl::AsciiStrToUpper(word);
  for (char& letter : name) letter = letter == '-' ? '_' : letter;
  v1::RobotEventKind kind = v1::ROBOT_EVENT_KIND_UNSPECIFIED;
  if (!v1::RobotEventKind_Parse(name, &kind))
    return OptionFault("KIND", word, "collision, motor-change, temperature, relocation or note");
  event.set_kind(kind);
  return absl::OkStatus();
}

absl::Status SetTime(const std::string& text, Event& event) {
  if (text.empty()) return absl::OkStatus();
  absl::Time time;
  std::string error;
  if (!absl::ParseTime(absl::RFC3339_full, text, &time, &error))
    return OptionFault("--time", text, "such as 2026-11-23T08:30:00Z");
  event.mutable_event_time()->set_seconds(absl::ToUnixSeconds(time));
  return absl::OkStatus();
}

absl::Status SetTemperature(const std::string& text, Event& event) {
  double temperature_c = 0.0;
  if (text.empty()) return absl::OkStatus();
  if (!absl::SimpleAtod(text, &temperature_c))
    return OptionFault("--temperature", text, "degrees Celsius");
  event.set_temperature_c(temperature_c);
  return absl::OkStatus();
}

absl::StatusOr<Event> EventFrom(const Told& told) {
  Event event;
  TRUEPOSE_RETURN_IF_ERROR(SetKind(told.kind, event));
  TRUEPOSE_RETURN_IF_ERROR(SetTime(told.time, event));
  event.set_joint(told.joint);
  event.set_description(told.description);
  TRUEPOSE_RETURN_IF_ERROR(SetTemperature(told.temperature_c, event));
  return event;
}

std::string EventsTable(const v1::ListRobotEventsResponse& list) {
  if (list.robot_events().empty())
    return "No events. Next: truepose robot-event add ROBOT collision\n";
  Table table({{"robot", Align::kLeft},
               {"event", Align::kLeft},
               {"joint"},
               {"deg C"},
               {"happened", Align::kLeft},
               {"by", Align::kLeft},
               {"description", Align::kLeft}});
  for (const Event& event : list.robot_events()) {
    table.Add({ShortName(RobotOf(event.name())),
               absl::AsciiStrToLower(v1::RobotEventKind_Name(event.kind())),
               event.joint() > 0 ? absl::StrCat(event.joint()) : "",
               event.has_temperature_c() ? Fixed(event.temperature_c(), 1) : "",
               TimeText(event.has_event_time() ? event.event_time() : event.create_time()),
               event.created_by(), event.description()});
  }
  return table.Text();
}

std::string AddedText(const Event& event) {
  v1::ListRobotEventsResponse one;
  *one.add_robot_events() = event;
  const std::string robot = ShortName(RobotOf(event.name()));
  return absl::StrCat(EventsTable(one), "Next, whether it called for a recalibration: truepose ",
                      "recalibration list --robot ", robot, "\n");
}

absl::Status Add(const Invocation& invocation, const Told& told) {
  v1::CreateRobotEventRequest request;
  request.set_parent(RobotName(told.robot));
  request.set_robot_event_id(RandomUuid());
  request.set_validate_only(told.dry_run);
  TRUEPOSE_ASSIGN_OR_RETURN(*request.mutable_robot_event(), EventFrom(told));
  return WithServer(invocation, kRobotHint, [&](const client::Client& client) -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(const Event event, client.CreateRobotEvent(request));
    return Reply(invocation, event, [&] { return AddedText(event); });
  });
}

}  // namespace

void AddRobotEvent(const Command& root) {
  const Command group = root.Add("robot-event", "What happened to a robot");
  group.Footer("Example:\n  truepose robot-event list --robot ur10");
  const auto told = std::make_shared<Told>();
  group.Add("add", "Report an event; one that a policy names raises a recalibration request")
      .Required("ROBOT", "", &told->robot, "Such as ur10")
      .Required("KIND", "", &told->kind, "collision, motor-change, temperature, relocation or note")
      .Option("--joint", "N", &told->joint, "Of a motor change, from 1")
      .Option("--temperature", "C", &told->temperature_c, "At the robot, degrees Celsius")
      .Option("--time", "TIME", &told->time, "When it happened; default: now")
      .Option("--dry-run", "", &told->dry_run, "Only check it; nothing is stored or raised")
      .Option("--description", "TEXT", &told->description, "For those who read it later")
      .Footer(
          "Examples:\n  truepose robot-event add ur10 collision --description 'the fixture'\n"
          "  truepose robot-event add ur10 motor-change --joint 3 --time 2026-11-23T08:30:00Z\n"
          "  truepose robot-event add ur10 temperature --temperature 27.5")
      .Run(Command::Reach::kRemote,
           [told](const Invocation& invocation) { return Add(invocation, *told); });
  const auto listed = std::make_shared<ListOptions>();
  const Command list = group.Add("list", "List the events, oldest first");
  AddListOptions(list, {.robot = true, .deleted = false, .example = "kind = \"COLLISION\""},
                 listed.get());
  list.Footer(
          "Examples:\n  truepose robot-event list\n"
          "  truepose robot-event list --robot ur10 --json")
      .Run(Command::Reach::kRemote, [listed](const Invocation& invocation) {
        return ReplyAllPages(invocation, *listed, &client::Client::ListRobotEvents, EventsTable);
      });
}

}  // namespace truepose::cli
