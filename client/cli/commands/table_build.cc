// truepose table estimate and build.
#include "convert/table_build.h"

#include <memory>
#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/cli/commands/table.h"
#include "client/cli/commands/table_remote.h"
#include "client/cli/interrupt.h"
#include "client/cli/output_file.h"
#include "client/cli/progress.h"
#include "client/cli/reply.h"
#include "client/cli/table_text.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

absl::StatusOr<convert::TableFile> BuildWithProgress(const Invocation& invocation,
                                                     const v1::CompensationTableInput& input) {
  ProgressBar bar(invocation.console, "table");
  const InterruptScope interrupt;
  convert::RunHooks hooks;
  hooks.on_progress = [&](const v1::JobProgress& progress) {
    bar.Show(progress.fraction(), progress.stage());
  };
  hooks.is_cancelled = [&] { return interrupt.interrupted(); };
  return convert::RunTableBuild(input, hooks);
}

absl::Status BuildLocally(const Invocation& invocation, const TableOptions& options) {
  if (options.output.empty()) return UsageError("--local needs --output FILE");
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::CompensationTableInput input, LoadTableInput(options));
  TRUEPOSE_ASSIGN_OR_RETURN(OutputFile output, OutputFile::Create(options.output, "--output"));
  const absl::StatusOr<convert::TableFile> file = BuildWithProgress(invocation, input);
  if (!file.ok()) return AsFaultOfInput(RenameFields(file.status(), TableFields()));
  TRUEPOSE_RETURN_IF_ERROR(output.Commit(file->bytes));
  return Reply(invocation, file->header, [&] {
    return absl::StrCat(TableText(file->header), "\nWritten to ", options.output, "\n");
  });
}

absl::Status EstimateLocally(const Invocation& invocation, const TableOptions& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::CompensationTableInput input, LoadTableInput(options));
  const auto estimate = convert::RunTableEstimate(input);
  if (!estimate.ok()) return AsFaultOfInput(RenameFields(estimate.status(), TableFields()));
  return Reply(invocation, *estimate, [&] { return EstimateText(*estimate); });
}

absl::StatusOr<RemoteTable> RemoteOf(const TableOptions& options) {
  TRUEPOSE_RETURN_IF_ERROR(CheckNoEnds(options.ends));
  RemoteTable wanted{options.robot,
                     options.calibration,
                     {},
                     !options.spec.empty() || !options.set.empty(),
                     options.allow_draft,
                     options.no_wait,
                     options.output};
  TRUEPOSE_ASSIGN_OR_RETURN(wanted.spec, LoadTableSpec(options));
  return wanted;
}

absl::Status Build(const Invocation& invocation, const TableOptions& options) {
  if (options.local) return BuildLocally(invocation, options);
  TRUEPOSE_ASSIGN_OR_RETURN(const RemoteTable wanted, RemoteOf(options));
  return BuildTableOnServer(invocation, wanted);
}

absl::Status Estimate(const Invocation& invocation, const TableOptions& options) {
  if (options.local) return EstimateLocally(invocation, options);
  TRUEPOSE_ASSIGN_OR_RETURN(const RemoteTable wanted, RemoteOf(options));
  return EstimateTableOnServer(invocation, wanted);
}

const Command& AddSources(const Command& command, TableOptions* options) {
  command.Option("--local", "", &options->local, "Compute here, from files, without a server")
      .Option("--robot", "NAME|FILE", &options->robot,
              "Such as ur10: its active calibration; with --local the robot file")
      .Option("--calibration", "NAME|FILE", &options->calibration,
              "Such as ur10#3; with --local a file")
      .Option("--urdf-base", "LINK", &options->ends.base, kUrdfBaseHelp)
      .Option("--urdf-tip", "LINK", &options->ends.tip, kUrdfTipHelp)
      .Option("--allow-draft", "", &options->allow_draft,
              "Also of a calibration that nobody has approved, for trying it");
  AddTableSpecOptions(command, options);
  return command;
}

}  // namespace

void AddTableEstimate(const Command& table) {
  const auto options = std::make_shared<TableOptions>();
  const Command command =
      table.Add("estimate", "Nodes, size and error of a table, without building it");
  AddSources(command, options.get())
      .Footer(absl::StrCat(
          kTableSpecHelp,
          "\nExamples:\n  truepose table estimate --robot ur10 --spec cell.yaml\n"
          "  truepose table estimate --local --robot ur10.yaml --calibration ur10.json --spec "
          "cell.yaml --set position_tolerance_mm=0.05"))
      .Run(Command::Reach::kRemote,
           [options](const Invocation& invocation) { return Estimate(invocation, *options); });
}

void AddTableBuild(const Command& table) {
  const auto options = std::make_shared<TableOptions>();
  const Command command = table.Add("build", "Build and verify a table");
  AddSources(command, options.get())
      .Option("--no-wait", "", &options->no_wait, "On a server: only queue the job")
      .Option("-o,--output", "FILE", &options->output,
              "Where the table goes; on a server it can stay there")
      .Footer(absl::StrCat(
          kTableSpecHelp,
          "Without --spec and --set a server takes the robot's table_spec.\n"
          "\nExamples:\n  truepose table build --robot ur10 --output ur10.tpct\n"
          "  truepose table build --calibration ur10#3 --spec cell.yaml\n"
          "  truepose table build --local --robot ur10.yaml --calibration ur10.json --spec "
          "cell.yaml --output ur10.tpct"))
      .Run(Command::Reach::kRemote,
           [options](const Invocation& invocation) { return Build(invocation, *options); });
}

}  // namespace truepose::cli
