// truepose calibration export: the robot as identified, for other programs.
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
  std::string calibration, robot;
  formats::UrdfEnds ends;
  ExportOptions exported;
};

absl::Status ExportLocally(const Invocation& invocation, const Options& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const LocalCalibration local,
                            LoadLocalCalibration(options.robot, options.ends, options.calibration));
  return Export(invocation, options.exported, local.robot, &local.calibration);
}

absl::Status ExportFromServer(const Invocation& invocation, const Options& options) {
  TRUEPOSE_RETURN_IF_ERROR(CheckNoEnds(options.ends));
  if (!options.robot.empty())
    return UsageError("--robot is for --local; on a server the calibration knows its robot");
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string name, CalibrationName(options.calibration));
  return WithServer(
      invocation, kCalibrationHint, [&](const client::Client& client) -> absl::Status {
        TRUEPOSE_ASSIGN_OR_RETURN(const CalibratedRobot robot, GetCalibratedRobot(client, name));
        const formats::RobotFile file{ShortName(RobotOf(name)), robot.nominal,
                                      formats::FieldLines()};
        return Export(invocation, options.exported, file, &robot.calibration);
      });
}

absl::Status ExportCalibration(const Invocation& invocation, const Options& options) {
  TRUEPOSE_RETURN_IF_ERROR(CheckFormat(options.exported));
  return options.local ? ExportLocally(invocation, options) : ExportFromServer(invocation, options);
}

}  // namespace

void AddCalibrationExport(const Command& calibration) {
  const auto options = std::make_shared<Options>();
  const Command command =
      calibration.Add("export", "Write the robot as identified, for other programs");
  command.Required("CALIBRATION", "", &options->calibration, "Such as ur10#1; with --local a file");
  AddExportOptions(command, &options->exported);
  command.Option("--local", "", &options->local, "Work here, from files, without a server")
      .Option("--robot", "FILE", &options->robot, "With --local: the robot file")
      .Option("--urdf-base", "LINK", &options->ends.base, kUrdfBaseHelp)
      .Option("--urdf-tip", "LINK", &options->ends.tip, kUrdfTipHelp)
      .Footer(
          "Examples:\n  truepose calibration export ur10#1 --format urdf -o ur10.urdf\n"
          "  truepose calibration export ur10#1 --format ur_calibration -o ur10_calibration.yaml\n"
          "  truepose calibration export ur10.calibration.json --local --robot ur10.yaml --format "
          "dh")
      .Run(Command::Reach::kRemote, [options](const Invocation& invocation) {
        return ExportCalibration(invocation, *options);
      });
}

}  // namespace truepose::cli
