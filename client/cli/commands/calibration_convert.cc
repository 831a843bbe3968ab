// truepose calibration convert: the same calibration in the parameters of another model.
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/cli/commands/commands.h"
#include "client/cli/inputs.h"
#include "client/cli/json.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "client/cli/output_file.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/report.h"
#include "convert/run.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

struct Options {
  bool local = false;
  std::string calibration, model, robot, output;
  formats::UrdfEnds ends;
};

std::string Text(const v1::Calibration& calibration, const std::string& from) {
  const v1::CalibrationReport& report = calibration.report();
  std::string text = absl::StrCat(
      "Calibration ", from, " in ", report.model(), "\n  convention ", report.convention(),
      "\n  SHA-256 ", calibration.digest(), "\n\nParameters\n",
      ParametersTable(report.parameters(), /*from_earlier=*/false),
      "\nTool in the frame of the flange, base in that of the "
      "instrument\n",
      FramesTable(report), "\nParameters that stay at nominal\n", RedundanciesText(report));
  for (const std::string& warning : report.warnings())
    absl::StrAppend(&text, "\nWarning: ", warning);
  return absl::StrCat(text, report.warnings().empty() ? "" : "\n");
}

absl::Status ConvertAndReply(const Invocation& invocation, const Options& options,
                             const v1::Nominal& nominal, const v1::Calibration& calibration) {
  const auto converted = convert::RunConversion(nominal, calibration, options.model);
  if (!converted.ok())
    return RenameFields(converted.status(), {{"options.model", "--model"},
                                             {"calibration.", options.calibration + ": "}});
  if (!options.output.empty()) {
    TRUEPOSE_ASSIGN_OR_RETURN(const std::string json, ToJson(*converted, /*pretty=*/true));
    TRUEPOSE_ASSIGN_OR_RETURN(OutputFile file, OutputFile::Create(options.output, "--output"));
    TRUEPOSE_RETURN_IF_ERROR(file.Commit(json));
  }
  return Reply(invocation, *converted, [&] { return Text(*converted, options.calibration); });
}

absl::Status ConvertFile(const Invocation& invocation, const Options& options) {
  if (options.robot.empty()) return UsageError("a calibration in a file needs --robot FILE");
  TRUEPOSE_ASSIGN_OR_RETURN(const LocalCalibration local,
                            LoadLocalCalibration(options.robot, options.ends, options.calibration));
  return ConvertAndReply(invocation, options, local.robot.nominal, local.calibration);
}

absl::Status ConvertStored(const Invocation& invocation, const Options& options) {
  TRUEPOSE_RETURN_IF_ERROR(CheckNoEnds(options.ends));
  if (!options.robot.empty())
    return UsageError("--robot is for a file; on a server the calibration knows its robot");
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string name, CalibrationName(options.calibration));
  return WithServer(
      invocation, kCalibrationHint, [&](const client::Client& client) -> absl::Status {
        TRUEPOSE_ASSIGN_OR_RETURN(const CalibratedRobot robot, GetCalibratedRobot(client, name));
        return ConvertAndReply(invocation, options, robot.nominal, robot.calibration);
      });
}

absl::Status ConvertCalibration(const Invocation& invocation, const Options& options) {
  std::error_code error;
  const bool file = std::filesystem::is_regular_file(options.calibration, error);
  return options.local || file || !options.robot.empty() ? ConvertFile(invocation, options)
                                                         : ConvertStored(invocation, options);
}

}  // namespace

void AddCalibrationConvert(const Command& calibration) {
  const auto options = std::make_shared<Options>();
  calibration.Add("convert", "Express a calibration in another model, prediction unchanged")
      .Required("CALIBRATION", "", &options->calibration,
                "Such as ur10#1, or a file of --output with --robot")
      .Required("--model", "NAME", &options->model,
                "modified_incremental, incremental, extended_dh or zhuang_roth")
      .Option("--output", "FILE", &options->output, "Also write it as JSON, for --local commands")
      .Option("--local", "", &options->local, "CALIBRATION is a file; no server is asked")
      .Option("--robot", "FILE", &options->robot, "Of a file: the robot file it was made from")
      .Option("--urdf-base", "LINK", &options->ends.base, kUrdfBaseHelp)
      .Option("--urdf-tip", "LINK", &options->ends.tip, kUrdfTipHelp)
      .Footer(
          "Computed here; nothing is stored. The covariance goes along; where the other model is\n"
          "singular for this robot, the joint is named and nothing is written.\n\nExamples:\n"
          "  truepose calibration convert ur10#1 --model zhuang_roth\n"
          "  truepose calibration convert ur10.calibration.json --robot ur10.yaml "
          "--model extended_dh \\\n    --output ur10.extended_dh.json")
      .Run(Command::Reach::kRemote, [options](const Invocation& invocation) {
        return ConvertCalibration(invocation, *options);
      });
}

}  // namespace truepose::cli
