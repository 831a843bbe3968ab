// truepose calibrate
#include "client/cli/commands/calibrate.h"

#include <memory>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "client/cli/commands/commands.h"
#include "client/cli/inputs.h"
#include "client/cli/json.h"
#include "client/cli/outcome.h"
#include "client/cli/reply.h"
#include "client/cli/report.h"
#include "client/cli/report_findings.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

constexpr char kFooter[] =
    R"(--split says which rows calibrate; the others are the control set. Rows count from 0.
  even-odd                  even rows calibrate
  first:N                   the first N
  every:K                   rows 0, K, 2K...
  spaced:N                  N rows, evenly spaced
  random:SEED[:FRACTION]    FRACTION (0.5) of the rows, drawn with this seed
  column:NAME=VALUE         all but the rows with this value

Rows of suspects and residuals count from 0 as well, in the text and with --json, where sessions
count from 0 in the order they were given.

)";

constexpr char kExamples[] =
    R"(Examples:
  truepose calibrate --robot ur10 --session 5f0c2c1e-8a53-4f0e-9a51-6f1f0f1f7a11 --split even-odd
  truepose calibrate --local --robot ur10.yaml --session series_C.csv --split even-odd
  truepose calibrate --local --robot ur10.yaml --session a.csv --session b.csv --split spaced:100 \
    --output ur10.calibration.json
  truepose calibrate --local --robot arm.yaml --session points.csv --observe point --json
  truepose calibrate --local --robot ur10.yaml --session series_D.csv --split even-odd --effects auto
  truepose calibrate --local --robot arm.yaml --session dime.csv --split first:40 \
    --estimator simplex --objective e_op
  truepose calibrate --local --robot panda.yaml --session panda_3.csv --fixture sockets.yaml \
    --feature-column hole --split even-odd
  truepose calibrate --local --robot ur10.yaml --session after_repair.csv --calibrate dq3 \
    --prior ur10.calibration.json
  truepose calibrate --local --robot ur10.yaml --session series_C.csv --preview)";

absl::Status CheckUsage(const CalibrateOptions& options) {
  if (options.local && options.no_wait)
    return UsageError("--no-wait is for a server; leave it out with --local");
  if (!options.local && !options.euler.empty()) {
    return UsageError(
        "--euler belongs to reading a file: give it to `truepose session import`, or use --local");
  }
  if (options.preview && (options.no_wait || !options.output.empty()))
    return UsageError("--preview runs nothing: leave out --no-wait and --output");
  if (options.no_wait && !options.output.empty()) {
    return UsageError("--output needs the result, for which --no-wait does not wait");
  }
  return absl::OkStatus();
}

absl::Status Calibrate(const Invocation& invocation, CalibrateOptions options) {
  TRUEPOSE_RETURN_IF_ERROR(CheckUsage(options));
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Observe observe, ParseObserve(options.observe));
  options.calibration.set_observe(observe);
  if (!options.local) TRUEPOSE_RETURN_IF_ERROR(CheckNoEnds(options.ends));
  return options.local ? CalibrateLocally(invocation, options)
                       : CalibrateOnServer(invocation, options);
}

// The texts and flags of the command line, which then go into the message.
struct Parsed {
  CalibrateOptions options;
  std::string split, group, tool;
  bool require_complete = false;
  bool strict_limits = false;

  CalibrateOptions Complete() const {
    CalibrateOptions complete = options;
    v1::CalibrationOptions& calibration = complete.calibration;
    calibration.set_split(split);
    calibration.set_group_column(group);
    calibration.set_nominal_tool(tool);
    calibration.set_require_complete(require_complete);
    calibration.set_strict_limits(strict_limits);
    return complete;
  }
};

}  // namespace

absl::Status AsTyped(const absl::Status& status, const CalibrateOptions& options) {
  Renaming renaming = {{"options.split", "--split"},
                       {"options.group_column", "--group"},
                       {"options.nominal_tool", "--tool"},
                       {"options.observe", "--observe"}};
  for (auto& name : IdentificationNames()) renaming.push_back(std::move(name));
  for (size_t i = 0; i < options.sessions.size(); ++i) {
    const std::string field = absl::StrCat("sessions[", i, "]");
    renaming.push_back({field + ".", options.sessions[i] + ": "});
    renaming.push_back({field, options.sessions[i]});
  }
  return RenameFields(status, renaming);
}

std::string StageText(const v1::JobProgress& progress) {
  const std::string stage = absl::StrReplaceAll(progress.stage(), {{"_", " "}});
  if (progress.iteration() == 0) return stage;
  return absl::StrCat(stage, ", iteration ", progress.iteration());
}

absl::StatusOr<std::optional<OutputFile>> OpenOutput(const CalibrateOptions& options) {
  if (options.output.empty()) return std::optional<OutputFile>();
  TRUEPOSE_ASSIGN_OR_RETURN(OutputFile file, OutputFile::Create(options.output, "--output"));
  return std::optional<OutputFile>(std::move(file));
}

bool Converged(const v1::CalibrationReport& report) {
  return report.summary().termination().empty() || report.summary().termination() == "converged";
}

// What must not be applied is not handed on to compensation.
std::string NextAfter(const v1::Calibration& calibration, const std::string& next_step) {
  if (calibration.report().verdict() != "do_not_apply") return next_step;
  const v1::CalibrationReport& report = calibration.report();
  if (!Converged(report))
    return "not converged: try --estimator levenberg_marquardt, then more different poses or "
           "--prior tolerance";
  if (report.has_change() && report.change().names_size() > 0 && !report.change().real())
    return "go on with the earlier calibration, unless a reason above says that the readings do "
           "not fit it";
  return "find the cause first: the reasons above, then units, order of joints and robot file";
}

absl::Status Deliver(const Invocation& invocation, const v1::Calibration& calibration,
                     std::optional<OutputFile> output, const std::string& next_step) {
  if (output.has_value()) {
    TRUEPOSE_ASSIGN_OR_RETURN(const std::string json, ToJson(calibration, /*pretty=*/true));
    TRUEPOSE_RETURN_IF_ERROR(output->Commit(json));
  }
  TRUEPOSE_RETURN_IF_ERROR(Reply(invocation, calibration.report(), [&] {
    return absl::StrCat(CalibrationText(calibration, invocation.console),
                        "Next: ", NextAfter(calibration, next_step), "\n");
  }));
  if (Converged(calibration.report())) return absl::OkStatus();
  return AnsweredFailure(absl::StrCat("the identification did not converge: ",
                                      calibration.report().summary().termination()));
}

absl::Status ReplyPreview(const Invocation& invocation, const v1::JobPreview& preview) {
  return Reply(invocation, preview, [&] { return PreviewText(preview); });
}

void AddCalibrate(const Command& root) {
  const auto parsed = std::make_shared<Parsed>();
  CalibrateOptions& options = parsed->options;
  const Command command = root.Add("calibrate", "Identify a robot's parameters from sessions");
  command.Option("--local", "", &options.local, "Compute here, from files, without a server")
      .Required("--robot", "NAME|FILE", &options.robot,
                "Robot on the server; with --local a robot file")
      .Required("--session", "UUID|FILE", &options.sessions,
                "Sealed sessions; with --local session files")
      .Option("--split", "SPEC", &parsed->split, "Which rows calibrate (below); default: all")
      .Option("--group", "COLUMN", &parsed->group,
              "Never separate rows with equal values of this column")
      .Option("--observe", "KIND", &options.observe,
              "Use only the pose, point or point_axis; default: all there is")
      .Option("--tool", "NAME", &parsed->tool, "Tool of the robot file that the target is near to")
      .Option("--require-complete", "", &parsed->require_complete,
              "Parameters that can't be told apart are an error")
      .Option("--strict-limits", "", &parsed->strict_limits, "A joint beyond its limit is an error")
      .Option("--euler", "CONVENTION", &options.euler,
              "With --local: read rx_,ry_,rz_ columns, such as xyz-intrinsic")
      .Option("--urdf-base", "LINK", &options.ends.base, kUrdfBaseHelp)
      .Option("--urdf-tip", "LINK", &options.ends.tip, kUrdfTipHelp)
      .Option("--output", "FILE", &options.output,
              "Also write the calibration as JSON, for --local commands")
      .Option("--preview", "", &options.preview,
              "Only say which parameters these readings determine; nothing runs")
      .Option("--no-wait", "", &options.no_wait, "Print the job and do not wait for it");
  AddIdentificationOptions(command, &options.identification);
  command.Footer(absl::StrCat(kFooter, kIdentificationFooter, kExamples))
      .Run(Command::Reach::kRemote, [parsed](const Invocation& invocation) {
        return Calibrate(invocation, parsed->Complete());
      });
}

}  // namespace truepose::cli
