// truepose robot add|list|show; export, update, delete and undelete are files of their own
#include <cmath>
#include <memory>
#include <numbers>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "client/cli/commands/commands.h"
#include "client/cli/commands/list_options.h"
#include "client/cli/commands/resource.h"
#include "client/cli/inputs.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/report.h"
#include "client/cli/table.h"
#include "client/pager.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

constexpr char kOtherContentHint[] =
    "The robot is there with another content. Give --new-revision to add this file as its next "
    "nominal, or --name to "
    "add another robot.";

struct AddOptions {
  std::string file;
  std::string name;
  formats::UrdfEnds ends;
  bool new_revision = false;
};

absl::StatusOr<v1::Robot> GetRobot(const client::Client& client, const std::string& name) {
  v1::GetRobotRequest request;
  request.set_name(name);
  return client.GetRobot(request);
}

absl::StatusOr<v1::Robot> CreateRobot(const client::Client& client, const std::string& id,
                                      const v1::Nominal& nominal) {
  v1::CreateRobotRequest request;
  request.set_robot_id(id);
  *request.mutable_nominal() = nominal;
  return client.CreateRobot(request);
}

absl::StatusOr<v1::Robot> AddRevision(const client::Client& client, const std::string& id,
                                      const v1::Nominal& nominal) {
  v1::CreateNominalRevisionRequest request;
  request.set_parent(RobotName(id));
  *request.mutable_nominal() = nominal;
  TRUEPOSE_RETURN_IF_ERROR(client.CreateNominalRevision(request).status());
  return GetRobot(client, request.parent());
}

std::string AddedText(const v1::Robot& robot) {
  const std::string id = ShortName(robot.name());
  return absl::StrCat("Robot ", id, ": ",
                      Count(robot.nominal_revision().nominal().joints_size(), "joint"),
                      ", nominal revision ", robot.nominal_revision().name(),
                      "\nNext: truepose session import FILE.csv --robot ", id, "\n");
}

absl::Status Add(const Invocation& invocation, const AddOptions& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const formats::RobotFile file, LoadRobot(options.file, options.ends));
  const std::string id = options.name.empty() ? file.robot_id : ShortName(options.name);
  return WithServer(invocation, kRobotHint, [&](const client::Client& client) -> absl::Status {
    const auto add = options.new_revision ? AddRevision : CreateRobot;
    const absl::StatusOr<v1::Robot> robot = add(client, id, file.nominal);
    if (!robot.ok()) {
      return WithHint(formats::LocateFaults(robot.status(), file.lines),
                      absl::StatusCode::kAlreadyExists, kOtherContentHint);
    }
    return Reply(invocation, *robot, [&] { return AddedText(*robot); });
  });
}

std::string KindText(v1::RobotKind kind) {
  return kind == v1::MEASURING ? "measuring" : "industrial";
}

std::string MakeText(const v1::Nominal& nominal) {
  return absl::StrCat(nominal.manufacturer(), nominal.manufacturer().empty() ? "" : " ",
                      nominal.model());
}

std::string RobotsTable(const v1::ListRobotsResponse& list) {
  if (list.robots().empty()) return "No robots yet. Next: truepose robot add FILE.yaml\n";
  Table table({{"robot", Align::kLeft},
               {"kind", Align::kLeft},
               {"model", Align::kLeft},
               {"serial", Align::kLeft},
               {"joints"},
               {"nominal", Align::kLeft},
               {"active", Align::kLeft},
               {"added", Align::kLeft}});
  for (const v1::Robot& robot : list.robots()) {
    const v1::Nominal& nominal = robot.nominal_revision().nominal();
    table.Add({ShortName(robot.name()), KindText(nominal.kind()), MakeText(nominal),
               nominal.serial(), absl::StrCat(nominal.joints_size()),
               robot.nominal_revision().name(), ShortName(robot.active_calibration()),
               TimeText(robot.create_time())});
  }
  return table.Text();
}

absl::Status List(const Invocation& invocation, const ListOptions& options) {
  return WithServer(invocation, "", [&](const client::Client& client) -> absl::Status {
    v1::ListRobotsRequest first;
    SetListOptions(options, first);
    v1::ListRobotsResponse all;
    TRUEPOSE_RETURN_IF_ERROR(AsListed(client::ForEachPage(
        first, [&](const auto& request) { return client.ListRobots(request); },
        [&](const v1::ListRobotsResponse& page) {
          all.MergeFrom(page);
          return absl::OkStatus();
        })));
    all.clear_next_page_token();
    return Reply(invocation, all, [&] { return RobotsTable(all); });
  });
}

std::string LimitText(const v1::Joint& joint, bool present, double limit) {
  if (!present) return "";
  return joint.type() == v1::PRISMATIC ? Fixed(1e3 * limit, 3)
                                       : Fixed(limit * 180.0 / std::numbers::pi, 3);
}

std::string JointsTable(const v1::Nominal& nominal) {
  Table table({{"joint", Align::kLeft},
               {"type", Align::kLeft},
               {"lower"},
               {"upper"},
               {"unit", Align::kLeft}});
  for (const v1::Joint& joint : nominal.joints()) {
    const bool prismatic = joint.type() == v1::PRISMATIC;
    table.Add({joint.name(), prismatic ? "prismatic" : "revolute",
               LimitText(joint, joint.has_lower(), joint.lower()),
               LimitText(joint, joint.has_upper(), joint.upper()), prismatic ? "mm" : "deg"});
  }
  return table.Text("  ");
}

std::string ToolsTable(const v1::Nominal& nominal) {
  Table table(
      {{"tool", Align::kLeft}, {"x mm"}, {"y mm"}, {"z mm"}, {"qx"}, {"qy"}, {"qz"}, {"qw"}});
  for (const v1::Tool& tool : nominal.tools()) {
    const v1::Pose& pose = tool.pose();
    table.Add({tool.name(), Fixed(1e3 * pose.x_m(), 3), Fixed(1e3 * pose.y_m(), 3),
               Fixed(1e3 * pose.z_m(), 3), Fixed(pose.qx(), 6), Fixed(pose.qy(), 6),
               Fixed(pose.qz(), 6), Fixed(pose.qw(), 6)});
  }
  return table.empty() ? "" : table.Text("  ");
}

// "two person", "automatic within limits"
std::string PolicyText(v1::ReleasePolicy policy) {
  if (policy == v1::RELEASE_POLICY_UNSPECIFIED) policy = v1::TWO_PERSON;
  return absl::AsciiStrToLower(absl::StrReplaceAll(v1::ReleasePolicy_Name(policy), {{"_", " "}}));
}

void AppendLimit(const char* what, double limit_mm, std::string* text) {
  if (limit_mm > 0.0) absl::StrAppend(text, ", ", what, " ", Fixed(limit_mm, 3), " mm");
}

std::string ReleaseText(const v1::Robot& robot) {
  const std::string& active = robot.active_calibration();
  std::string text = absl::StrCat("Active ", active.empty() ? "none" : ShortName(active),
                                  "; release ", PolicyText(robot.release_policy()));
  AppendLimit("control RMS at most", robot.limits().control_rms_mm(), &text);
  AppendLimit("change at most", robot.limits().change_mm(), &text);
  AppendLimit("recalibration asked for from a check's RMS of", robot.limits().drift_rms_mm(),
              &text);
  return absl::StrCat(text, "\n");
}

std::string RobotText(const v1::Robot& robot) {
  const v1::NominalRevision& revision = robot.nominal_revision();
  const v1::Nominal& nominal = revision.nominal();
  std::string text =
      absl::StrCat("Robot ", ShortName(robot.name()), ", ", KindText(nominal.kind()));
  const std::string make = MakeText(nominal);
  if (!make.empty()) absl::StrAppend(&text, ", ", make);
  if (!nominal.serial().empty()) absl::StrAppend(&text, ", serial ", nominal.serial());
  absl::StrAppend(&text, "\nNominal ", revision.name(), ", SHA-256 ", revision.digest(), "\n");
  return absl::StrCat(text, ReleaseText(robot), JointsTable(nominal), ToolsTable(nominal));
}

absl::Status Show(const Invocation& invocation, const std::string& name) {
  return WithServer(invocation, kRobotHint, [&](const client::Client& client) -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot, GetRobot(client, RobotName(name)));
    return Reply(invocation, robot, [&] { return RobotText(robot); });
  });
}

void AddAdd(const Command& robot) {
  const auto options = std::make_shared<AddOptions>();
  robot.Add("add", "Register the robot of a file")
      .Required("FILE", "", &options->file, "Robot file (YAML or URDF, docs/formats.md)")
      .Option("--name", "NAME", &options->name, "Name on the server; default: the file's `robot`")
      .Option("--new-revision", "", &options->new_revision,
              "Add the file as next nominal of a robot that is there")
      .Option("--urdf-base", "LINK", &options->ends.base, kUrdfBaseHelp)
      .Option("--urdf-tip", "LINK", &options->ends.tip, kUrdfTipHelp)
      .Footer(
          "Examples:\n  truepose robot add deploy/examples/ur10.yaml\n"
          "  truepose robot add ur10.yaml --name ur10-07\n"
          "  truepose robot add ur10.yaml --new-revision\n"
          "  truepose robot add ur10.urdf --urdf-tip tool0")
      .Run(Command::Reach::kRemote,
           [options](const Invocation& invocation) { return Add(invocation, *options); });
}

void AddList(const Command& robot) {
  const auto options = std::make_shared<ListOptions>();
  const Command list = robot.Add("list", "List the robots");
  AddListOptions(list, {.deleted = true, .example = "release_policy = \"TWO_PERSON\""},
                 options.get());
  list.Footer(
          "Examples:\n  truepose robot list\n"
          "  truepose robot list --filter 'display_name = \"*hall 3*\"' --json")
      .Run(Command::Reach::kRemote,
           [options](const Invocation& invocation) { return List(invocation, *options); });
}

}  // namespace

void AddRobot(const Command& root) {
  const Command robot = root.Add("robot", "Robots and their nominal geometry");
  robot.Footer("Example:\n  truepose robot list");
  AddAdd(robot);
  AddList(robot);
  const auto name = std::make_shared<std::string>();
  robot.Add("show", "Show one robot")
      .Required("NAME", "", name.get(), "Such as ur10")
      .Footer("Example:\n  truepose robot show ur10")
      .Run(Command::Reach::kRemote,
           [name](const Invocation& invocation) { return Show(invocation, *name); });
  AddResourceChanges(robot, RobotKindOfResource());
  AddRobotExport(robot);
}

}  // namespace truepose::cli
