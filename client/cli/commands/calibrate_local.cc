// truepose calibrate --local: files in, the same messages as a server's job, the same core.
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/cli/commands/calibrate.h"
#include "client/cli/inputs.h"
#include "client/cli/interrupt.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "client/cli/progress.h"
#include "convert/run.h"
#include "core/assessment/split.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

// The faults of the robot file and of the options come together.
absl::StatusOr<formats::RobotFile> LoadRobotAndOptions(CalibrateOptions* options) {
  FaultList faults;
  absl::StatusOr<formats::RobotFile> robot = LoadRobot(options->robot, options->ends);
  faults.AddAll(robot.status());
  const auto nominal = [&robot]() -> absl::StatusOr<v1::Nominal> {
    if (!robot.ok()) return robot.status();
    return robot->nominal;
  };
  const absl::Status written =
      WriteIdentificationOptions(options->identification, {}, nominal, &options->calibration);
  if (written != robot.status()) faults.AddAll(written);  // else told already
  if (written.ok())
    faults.AddAll(AsTyped(convert::ValidateOptions(options->calibration), *options));
  if (!faults.empty()) return faults.ToStatus();
  return robot;
}

// Columns that an option names; ValidateOptions has seen the split.
std::vector<std::string> ColumnsInUse(const v1::CalibrationOptions& options) {
  std::vector<std::string> columns = {options.feature_column(), options.group_column()};
  const auto split = ParseSplit(options.split());
  if (split.ok()) columns.push_back(split->column);
  return columns;
}

absl::StatusOr<v1::CalibrationInput> LoadInput(const Invocation& invocation,
                                               CalibrateOptions options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const formats::RobotFile robot, LoadRobotAndOptions(&options));
  TRUEPOSE_ASSIGN_OR_RETURN(
      std::vector<v1::SessionInput> sessions,
      LoadSessions(options.sessions, robot.nominal,
                   {options.euler, ColumnsInUse(options.calibration)}, invocation.console));
  v1::CalibrationInput input;
  input.set_robot(RobotName(robot.robot_id));
  input.set_nominal_revision(LocalRevision(robot));
  *input.mutable_nominal() = robot.nominal;
  *input.mutable_options() = options.calibration;
  for (v1::SessionInput& session : sessions) *input.add_sessions() = std::move(session);
  return input;
}

absl::StatusOr<v1::Calibration> RunWithProgress(const Invocation& invocation,
                                                const v1::CalibrationInput& input) {
  ProgressBar bar(invocation.console, "calibrate");
  const InterruptScope interrupt;
  convert::RunHooks hooks;
  hooks.on_progress = [&](const v1::JobProgress& progress) {
    bar.Show(progress.fraction(), StageText(progress));
  };
  hooks.is_cancelled = [&] { return interrupt.interrupted(); };
  return convert::RunCalibration(input, hooks);
}

std::string NextStep(const CalibrateOptions& options) {
  if (options.output.empty())
    return "repeat with --output FILE to keep the calibration for `truepose compensate --local`";
  return absl::StrCat("truepose compensate TARGETS.csv --local --robot ", options.robot,
                      " --calibration ", options.output);
}

absl::Status PreviewLocally(const Invocation& invocation, const v1::CalibrationInput& input,
                            const CalibrateOptions& options) {
  const absl::StatusOr<v1::JobPreview> preview = convert::RunPreview(input);
  if (!preview.ok()) return AsFaultOfInput(AsTyped(preview.status(), options));
  return ReplyPreview(invocation, *preview);
}

}  // namespace

absl::Status CalibrateLocally(const Invocation& invocation, const CalibrateOptions& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::CalibrationInput input, LoadInput(invocation, options));
  if (options.preview) return PreviewLocally(invocation, input, options);
  TRUEPOSE_ASSIGN_OR_RETURN(std::optional<OutputFile> output, OpenOutput(options));
  const absl::StatusOr<v1::Calibration> calibration = RunWithProgress(invocation, input);
  if (!calibration.ok()) return AsFaultOfInput(AsTyped(calibration.status(), options));
  return Deliver(invocation, *calibration, std::move(output), NextStep(options));
}

}  // namespace truepose::cli
