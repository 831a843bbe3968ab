// truepose table: compensation tables, the form of a calibration that a controller uses.
#include <memory>

#include "client/cli/commands/commands.h"
#include "client/cli/commands/table_remote.h"
#include "client/cli/outcome.h"
#include "core/base/status_macros.h"
#include "formats/message_file.h"

namespace truepose::cli {
namespace {

struct Options {
  RemoteTable table;
  std::string spec;
};

absl::Status ReadSpec(Options& options) {
  if (options.spec.empty()) return absl::OkStatus();
  options.table.has_spec = true;
  formats::GivenFields given;
  return AsInputFault(formats::ReadMessageFile(options.spec, options.table.spec, given));
}

const Command& AddSources(const Command& command, Options* options) {
  return command
      .Option("--robot", "NAME", &options->table.robot, "Such as ur10: its active calibration")
      .Option("--calibration", "NAME", &options->table.calibration, "Such as ur10#3")
      .Option("--spec", "FILE", &options->spec,
              "Domain and tolerances as YAML or JSON; default: the robot's table_spec")
      .Option("--allow-draft", "", &options->table.allow_draft,
              "Also of a calibration that nobody has approved, for trying it");
}

void AddEstimate(const Command& group) {
  const auto options = std::make_shared<Options>();
  const Command command =
      group.Add("estimate", "Nodes, size and error of a table, without building it");
  AddSources(command, options.get())
      .Footer("Example:\n  truepose table estimate --robot ur10 --spec cell.yaml")
      .Run(Command::Reach::kRemote, [options](const Invocation& invocation) -> absl::Status {
        TRUEPOSE_RETURN_IF_ERROR(ReadSpec(*options));
        return EstimateTableOnServer(invocation, options->table);
      });
}

void AddBuild(const Command& group) {
  const auto options = std::make_shared<Options>();
  const Command command = group.Add("build", "Build and verify a table");
  AddSources(command, options.get())
      .Option("--no-wait", "", &options->table.no_wait, "Only queue the job")
      .Option("-o,--output", "FILE", &options->table.output, "Also fetch the table")
      .Footer(
          "Examples:\n  truepose table build --robot ur10 --output ur10.tpct\n"
          "  truepose table build --calibration ur10#3 --spec cell.yaml")
      .Run(Command::Reach::kRemote, [options](const Invocation& invocation) -> absl::Status {
        TRUEPOSE_RETURN_IF_ERROR(ReadSpec(*options));
        return BuildTableOnServer(invocation, options->table);
      });
}

void AddShow(const Command& group) {
  const auto name = std::make_shared<std::string>();
  group.Add("show", "What a table is for, and how well it was verified")
      .Required("TABLE", "", name.get(),
                "ROBOT/UUID as of `table list`; a robot's name is its active table")
      .Footer("Examples:\n  truepose table show ur10\n  truepose table show ur10 --json")
      .Run(Command::Reach::kRemote,
           [name](const Invocation& invocation) { return ShowTableOnServer(invocation, *name); });
}

}  // namespace

void AddTable(const Command& root) {
  const Command table = root.Add("table", "Build, look at and fetch compensation tables");
  table.Footer("Example:\n  truepose table list --robot ur10");
  AddEstimate(table);
  AddBuild(table);
  AddShow(table);
  AddTableOnServer(table);
}

}  // namespace truepose::cli
