// truepose compensate: targets in, corrected targets out.
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "client/cli/commands/commands.h"
#include "client/cli/configuration_changes.h"
#include "client/cli/inputs.h"
#include "client/cli/large_changes.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "client/cli/output_file.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/table.h"
#include "client/cli/verdict.h"
#include "convert/run.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "formats/targets_file.h"

namespace truepose::cli {
namespace {

struct Options {
  bool local = false;
  std::string targets, calibration, robot, tool, output;
  formats::UrdfEnds ends;
};

bool AnyHasJoints(const v1::CompensateResponse& response) {
  for (const v1::CompensatedTarget& target : response.targets()) {
    if (!target.joints().empty()) return true;
  }
  return false;
}

// A pose is shown to those who asked with poses, and for a measuring robot, whose answer it is.
bool ShowsPoses(const v1::CompensateRequest& request, const v1::CompensateResponse& response) {
  for (const v1::CompensationTarget& target : request.targets()) {
    if (target.has_pose()) return true;
  }
  return !AnyHasJoints(response);
}

std::vector<Column> JointColumns(const v1::Nominal& nominal) {
  std::vector<Column> columns;
  for (int i = 0; i < nominal.joints_size(); ++i) {
    columns.push_back(
        {absl::StrCat("q", i + 1, nominal.joints(i).type() == v1::PRISMATIC ? " mm" : " deg")});
  }
  return columns;
}

void AddJoints(const v1::Nominal& nominal, const v1::CompensatedTarget& target,
               std::vector<std::string>* cells) {
  for (int i = 0; i < nominal.joints_size(); ++i) {
    const double unit = nominal.joints(i).type() == v1::PRISMATIC ? 1e3 : 180.0 / std::numbers::pi;
    cells->push_back(i < target.joints_size() ? Fixed(unit * target.joints(i), 4) : "");
  }
}

void AddPose(const v1::CompensatedTarget& target, std::vector<std::string>* cells) {
  const v1::Pose& pose = target.pose();
  for (const double length : {pose.x_m(), pose.y_m(), pose.z_m()}) {
    cells->push_back(target.has_pose() ? Fixed(1e3 * length, 3) : "");
  }
  for (const double part : {pose.qx(), pose.qy(), pose.qz(), pose.qw()}) {
    cells->push_back(target.has_pose() ? Fixed(part, 6) : "");
  }
}

std::string TargetsTable(const v1::Nominal& nominal, const v1::CompensateRequest& request,
                         const v1::CompensateResponse& response) {
  const bool joints = AnyHasJoints(response), poses = ShowsPoses(request, response);
  std::vector<Column> columns = {{"target"}};
  if (joints) {
    for (Column& column : JointColumns(nominal)) columns.push_back(std::move(column));
  }
  if (poses) {
    for (const char* title : {"x mm", "y mm", "z mm", "qx", "qy", "qz", "qw"})
      columns.push_back({title});
  }
  for (const char* title : {"corrected mm", "deg"}) columns.push_back({title});
  columns.push_back({"", Align::kLeft});
  Table table(std::move(columns));
  for (const v1::CompensatedTarget& target : response.targets()) {
    std::vector<std::string> cells = {absl::StrCat(target.row())};
    if (joints) AddJoints(nominal, target, &cells);
    if (poses) AddPose(target, &cells);
    const bool corrected = target.fault().empty();
    cells.push_back(corrected ? Fixed(target.position_correction_mm(), 3) : "");
    cells.push_back(corrected ? Fixed(target.rotation_correction_deg(), 4) : "");
    cells.push_back(target.fault());
    table.Add(std::move(cells));
  }
  return table.Text();
}

// A program with some corrected and some missing targets must not reach a robot unnoticed.
absl::Status FaultsOfTargets(const Options& options, const v1::CompensateResponse& response) {
  FaultList faults;
  for (const v1::CompensatedTarget& target : response.targets()) {
    if (target.fault().empty()) continue;
    faults.Add(absl::StrCat(options.targets, ": target ", target.row()), target.fault(), "");
  }
  return faults.ToStatus();
}

std::string Text(const Options& options, const v1::Nominal& nominal,
                 const v1::CompensateRequest& request, const v1::CompensateResponse& response) {
  if (options.output.empty()) return TargetsTable(nominal, request, response);
  return absl::StrCat(Count(response.targets_size(), "target"), " corrected, in ", options.output,
                      "\n");
}

absl::Status Deliver(const Invocation& invocation, const Options& options,
                     const v1::Nominal& nominal, const v1::CompensateRequest& request,
                     const v1::CompensateResponse& response, std::optional<OutputFile> output) {
  TRUEPOSE_RETURN_IF_ERROR(FaultsOfTargets(options, response));
  WarnOfConfigurationChanges(invocation.console, nominal, request, response);
  WarnOfLargeChanges(invocation.console, nominal, request, response);
  if (output.has_value()) {
    TRUEPOSE_RETURN_IF_ERROR(output->Commit(formats::WriteCompensatedTargets(nominal, response)));
  }
  return Reply(invocation, response, [&] { return Text(options, nominal, request, response); });
}

absl::StatusOr<v1::CompensateRequest> LoadRequest(const Options& options,
                                                  const v1::Nominal& nominal) {
  const absl::StatusOr<std::vector<v1::CompensationTarget>> targets =
      formats::ReadTargetsFile(options.targets, nominal);
  if (!targets.ok()) return AsInputFault(targets.status());
  v1::CompensateRequest request;
  request.set_tool(options.tool);
  for (const v1::CompensationTarget& target : *targets) *request.add_targets() = target;
  return request;
}

absl::StatusOr<std::optional<OutputFile>> OpenOutput(const std::string& path) {
  if (path.empty()) return std::optional<OutputFile>();
  TRUEPOSE_ASSIGN_OR_RETURN(OutputFile file, OutputFile::Create(path, "--output"));
  return std::optional<OutputFile>(std::move(file));
}

absl::Status CompensateLocally(const Invocation& invocation, const Options& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const LocalCalibration local,
                            LoadLocalCalibration(options.robot, options.ends, options.calibration));
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::CompensateRequest request,
                            LoadRequest(options, local.robot.nominal));
  TRUEPOSE_ASSIGN_OR_RETURN(std::optional<OutputFile> output, OpenOutput(options.output));
  TRUEPOSE_ASSIGN_OR_RETURN(
      const v1::CompensateResponse response,
      convert::RunCompensation(local.robot.nominal, local.calibration, request));
  WarnOfVerdict(invocation.console, local.calibration.report());
  return Deliver(invocation, options, local.robot.nominal, request, response, std::move(output));
}

absl::Status CompensateOnServer(const Invocation& invocation, const Options& options) {
  TRUEPOSE_RETURN_IF_ERROR(CheckNoEnds(options.ends));
  if (!options.robot.empty())
    return UsageError("--robot is for --local; on a server the calibration knows its robot");
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string name, CalibrationName(options.calibration));
  return WithServer(
      invocation, kCalibrationHint, [&](const client::Client& client) -> absl::Status {
        TRUEPOSE_ASSIGN_OR_RETURN(const CalibratedRobot robot, GetCalibratedRobot(client, name));
        TRUEPOSE_ASSIGN_OR_RETURN(v1::CompensateRequest request,
                                  LoadRequest(options, robot.nominal));
        TRUEPOSE_ASSIGN_OR_RETURN(std::optional<OutputFile> output, OpenOutput(options.output));
        request.set_calibration(name);
        TRUEPOSE_ASSIGN_OR_RETURN(const v1::CompensateResponse response,
                                  client.Compensate(request));
        WarnOfVerdict(invocation.console, robot.calibration.report());
        return Deliver(invocation, options, robot.nominal, request, response, std::move(output));
      });
}

}  // namespace

void AddCompensate(const Command& root) {
  const auto options = std::make_shared<Options>();
  root.Add("compensate", "Correct joint or pose targets by a calibration")
      .Required("TARGETS", "", &options->targets,
                "CSV with q1_rad... or x_mm,y_mm,z_mm,qx,qy,qz,qw (docs/formats.md)")
      .Option("--local", "", &options->local, "Compute here, from files, without a server")
      .Required("--calibration", "NAME|FILE", &options->calibration,
                "Such as ur10#1; with --local a file")
      .Option("--robot", "FILE", &options->robot, "With --local: the robot file")
      .Option("--urdf-base", "LINK", &options->ends.base, kUrdfBaseHelp)
      .Option("--urdf-tip", "LINK", &options->ends.tip, kUrdfTipHelp)
      .Option("--tool", "NAME", &options->tool,
              "Tool of the robot file for pose targets; default: the flange")
      .Option("--output", "FILE", &options->output,
              "Write the corrected targets as CSV; default: a table")
      .Footer(
          "When any target can't be corrected, each is named and no file is written.\n\nExamples:\n"
          "  truepose compensate targets.csv --calibration ur10#1 --output corrected.csv\n"
          "  truepose compensate targets.csv --local --robot ur10.yaml --calibration "
          "ur10.calibration.json")
      .Run(Command::Reach::kRemote, [options](const Invocation& invocation) {
        const auto compensate = options->local ? CompensateLocally : CompensateOnServer;
        return AsFaultOfVerdict(
            RenameFields(compensate(invocation, *options), {{"calibration.", "--calibration: "}}));
      });
}

}  // namespace truepose::cli
