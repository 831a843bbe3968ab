// truepose robot export: the nominal robot, for other programs; from URDF to our YAML, too.
#include <memory>

#include "client/cli/commands/commands.h"
#include "client/cli/export.h"
#include "client/cli/inputs.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "client/cli/remote.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

struct Options {
  bool local = false;
  std::string robot;
  formats::UrdfEnds ends;
  ExportOptions exported;
};

absl::Status ExportLocally(const Invocation& invocation, const Options& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const formats::RobotFile robot, LoadRobot(options.robot, options.ends));
  return Export(invocation, options.exported, robot, nullptr);
}

absl::Status ExportFromServer(const Invocation& invocation, const Options& options) {
  v1::GetRobotRequest request;
  request.set_name(RobotName(options.robot));
  return WithServer(invocation, kRobotHint, [&](const client::Client& client) -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot, client.GetRobot(request));
    const formats::RobotFile file{ShortName(robot.name()), robot.nominal_revision().nominal(),
                                  formats::FieldLines()};
    return Export(invocation, options.exported, file, nullptr);
  });
}

absl::Status ExportRobot(const Invocation& invocation, const Options& options) {
  TRUEPOSE_RETURN_IF_ERROR(CheckFormat(options.exported));
  return options.local ? ExportLocally(invocation, options) : ExportFromServer(invocation, options);
}

}  // namespace

void AddRobotExport(const Command& robot) {
  const auto options = std::make_shared<Options>();
  const Command command = robot.Add("export", "Write the nominal robot, for other programs");
  command.Required("ROBOT", "", &options->robot, "Such as ur10; with --local a robot file");
  AddExportOptions(command, &options->exported);
  command.Option("--local", "", &options->local, "Work here, from a file, without a server")
      .Option("--urdf-base", "LINK", &options->ends.base, kUrdfBaseHelp)
      .Option("--urdf-tip", "LINK", &options->ends.tip, kUrdfTipHelp)
      .Footer(
          "Examples:\n  truepose robot export ur10 --format urdf -o ur10.urdf\n"
          "  truepose robot export ur10.urdf --local --urdf-tip tool0 --format robot -o ur10.yaml")
      .Run(Command::Reach::kRemote,
           [options](const Invocation& invocation) { return ExportRobot(invocation, *options); });
}

}  // namespace truepose::cli
