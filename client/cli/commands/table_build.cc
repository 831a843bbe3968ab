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
#include "client/cli/verdict.h"
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
  if (!file.ok())
    return AsFaultOfInput(RenameFields(file.status(), TableFields(SpecPlace(options))));
  TRUEPOSE_RETURN_IF_ERROR(output.Commit(file->bytes));
  WarnOfVerdict(invocation.console, input.calibration().report());
  return Reply(invocation, file->header, [&] {
    return absl::StrCat(TableText(file->header), "\nWritten to ", options.output, "\n");
  });
}

absl::Status EstimateLocally(const Invocation& invocation, const TableOptions& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::CompensationTableInput input, LoadTableInput(options));
  const auto estimate = convert::RunTableEstimate(input);
  if (!estimate.ok())
    return AsFaultOfInput(RenameFields(estimate.status(), TableFields(SpecPlace(options))));
  return Reply(invocation, *estimate, [&] { return EstimateText(*estimate); });
}

const Command& AddSources(const Command& command, TableOptions* options) {
  command.Option("--local", "", &options->local, "Compute here, from files, without a server")
      .Option("--calibration", "NAME|FILE", &options->calibration,
              "Such as ur10#1; with --local a file; default: the robot's active one")
      .Option("--robot", "NAME|FILE", &options->robot, "Such as ur10; with --local the robot file")
      .Option("--urdf-base", "LINK", &options->ends.base, kUrdfBaseHelp)
      .Option("--urdf-tip", "LINK", &options->ends.tip, kUrdfTipHelp);
  AddTableSpecOptions(command, options);
  return command;
}

const Command& AddAllowDraft(const Command& command, TableOptions* options) {
  return command.Option("--allow-draft", "", &options->allow_draft,
                        "Also of a calibration that nobody has approved, for trying it");
}

// Without --spec and --set the robot's table_spec, else all defaults.
absl::StatusOr<RemoteTable> RemoteFrom(const TableOptions& options) {
  TRUEPOSE_RETURN_IF_ERROR(CheckNoEnds(options.ends));
  RemoteTable wanted{.robot = options.robot,
                     .calibration = options.calibration,
                     .spec = {},
                     .has_spec = !options.spec.empty() || !options.set.empty(),
                     .spec_place = SpecPlace(options),
                     .allow_draft = options.allow_draft,
                     .no_wait = options.no_wait,
                     .output = options.output};
  if (!wanted.has_spec) wanted.spec_place = "table_spec: ";
  TRUEPOSE_ASSIGN_OR_RETURN(wanted.spec, LoadTableSpec(options));
  return wanted;
}

absl::Status EstimateRemotely(const Invocation& invocation, const TableOptions& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const RemoteTable wanted, RemoteFrom(options));
  return EstimateTableOnServer(invocation, wanted);
}

absl::Status BuildRemotely(const Invocation& invocation, const TableOptions& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const RemoteTable wanted, RemoteFrom(options));
  return BuildTableOnServer(invocation, wanted);
}

}  // namespace

void AddTableEstimate(const Command& table) {
  const auto options = std::make_shared<TableOptions>();
  const Command command =
      table.Add("estimate", "Nodes, size and error of a table, without building it");
  AddAllowDraft(AddSources(command, options.get()), options.get())
      .Footer(absl::StrCat(
          kTableSpecHelp,
          "\nExamples:\n  truepose table estimate --robot ur10 --spec cell.yaml\n"
          "  truepose table estimate --local --robot ur10.yaml --calibration "
          "ur10.json --spec cell.yaml\n  truepose table estimate --local --robot ur10.yaml "
          "--calibration ur10.json --spec cell.yaml --set position_tolerance_mm=0.05"))
      .Run(Command::Reach::kRemote, [options](const Invocation& invocation) {
        const auto estimate = options->local ? EstimateLocally : EstimateRemotely;
        return estimate(invocation, *options);
      });
}

void AddTableBuild(const Command& table) {
  const auto options = std::make_shared<TableOptions>();
  const Command command = table.Add("build", "Build and verify a table");
  AddAllowDraft(AddSources(command, options.get()), options.get())
      .Option("--no-wait", "", &options->no_wait, "Only queue the job of a server")
      .Option("-o,--output", "FILE", &options->output,
              "Where the table goes; without it a server keeps it")
      .Footer(
          absl::StrCat(kTableSpecHelp,
                       "\nExamples:\n  truepose table build --robot ur10 --output ur10.tpct\n"
                       "  truepose table build --calibration ur10#3 --spec cell.yaml\n"
                       "  truepose table build --local --robot ur10.yaml --calibration ur10.json "
                       "--spec cell.yaml --output ur10.tpct\n  truepose table show ur10.tpct"))
      .Run(Command::Reach::kRemote, [options](const Invocation& invocation) {
        const auto build = options->local ? BuildLocally : BuildRemotely;
        return build(invocation, *options);
      });
}

}  // namespace truepose::cli
