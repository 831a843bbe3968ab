// truepose evaluate: a calibration applied to a session that had no part in it.
#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "client/cli/commands/commands.h"
#include "client/cli/histogram.h"
#include "client/cli/inputs.h"
#include "client/cli/names.h"
#include "client/cli/outcome.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/cli/report.h"
#include "convert/run.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

constexpr char kHint[] =
    "`truepose calibration list` and `truepose session list` show what this server has.";

struct Options {
  bool local = false;
  std::string calibration, session, robot, observe, euler, fixture, feature_column;
  formats::UrdfEnds ends;
};

std::string EvaluationText(const v1::Evaluation& evaluation, bool utf8) {
  std::vector<double> before, after;
  for (const v1::RowResidual& residual : evaluation.residuals()) {
    before.push_back(residual.before_position_mm());
    after.push_back(residual.after_position_mm());
  }
  std::string text = SetTable("evaluated", evaluation.set());
  if (!before.empty()) {
    absl::StrAppend(&text, "\nPosition residuals in mm\n",
                    BeforeAfterHistogram(before, after, "mm", utf8));
  }
  for (const std::string& warning : evaluation.warnings())
    absl::StrAppend(&text, "\nWarning: ", warning, "\n");
  return text;
}

absl::Status Deliver(const Invocation& invocation, const v1::Evaluation& evaluation) {
  return Reply(invocation, evaluation,
               [&] { return EvaluationText(evaluation, invocation.console.utf8); });
}

// As a server does; here a session is known by its file's name only.
void WarnOfOwnSession(const v1::Calibration& calibration, const std::string& session,
                      v1::Evaluation* evaluation) {
  const auto& own = calibration.sessions();
  if (std::find(own.begin(), own.end(), session) == own.end()) return;
  evaluation->add_warnings(
      "this session had a part in the calibration: the figures are no independent check");
}

// Another fixture, or another column, than the calibration's own.
absl::Status SetFixture(const Options& options, v1::Calibration* calibration) {
  if (!options.fixture.empty()) {
    TRUEPOSE_ASSIGN_OR_RETURN(*calibration->mutable_options()->mutable_fixture(),
                              LoadFixture(options.fixture));
  }
  if (!options.feature_column.empty())
    calibration->mutable_options()->set_feature_column(options.feature_column);
  return absl::OkStatus();
}

absl::Status EvaluateLocally(const Invocation& invocation, const Options& options,
                             v1::Observe observe) {
  TRUEPOSE_ASSIGN_OR_RETURN(LocalCalibration local,
                            LoadLocalCalibration(options.robot, options.ends, options.calibration));
  TRUEPOSE_RETURN_IF_ERROR(SetFixture(options, &local.calibration));
  TRUEPOSE_ASSIGN_OR_RETURN(
      const std::vector<v1::SessionInput> sessions,
      LoadSessions({options.session}, local.robot.nominal,
                   {options.euler, {local.calibration.options().feature_column()}},
                   invocation.console));
  TRUEPOSE_ASSIGN_OR_RETURN(
      v1::Evaluation evaluation,
      convert::RunEvaluation(local.robot.nominal, local.calibration, sessions[0], observe));
  WarnOfOwnSession(local.calibration, options.session, &evaluation);
  return Deliver(invocation, evaluation);
}

absl::Status EvaluateOnServer(const Invocation& invocation, const Options& options,
                              v1::Observe observe) {
  TRUEPOSE_RETURN_IF_ERROR(CheckNoEnds(options.ends));
  if (!options.robot.empty() || !options.euler.empty()) {
    return UsageError(
        "--robot and --euler are for --local; on a server the calibration and the session know "
        "both");
  }
  if (!options.fixture.empty() || !options.feature_column.empty())
    return UsageError(
        "--fixture and --feature-column are for --local; on a server those of the "
        "calibration count");
  v1::EvaluateRequest request;
  TRUEPOSE_ASSIGN_OR_RETURN(*request.mutable_calibration(), CalibrationName(options.calibration));
  request.set_session(SessionName(options.session));
  request.set_observe(observe);
  return WithServer(invocation, kHint, [&](const client::Client& client) -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::Evaluation evaluation, client.Evaluate(request));
    return Deliver(invocation, evaluation);
  });
}

absl::Status Evaluate(const Invocation& invocation, const Options& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Observe observe, ParseObserve(options.observe));
  return options.local ? EvaluateLocally(invocation, options, observe)
                       : EvaluateOnServer(invocation, options, observe);
}

}  // namespace

void AddEvaluate(const Command& root) {
  const auto options = std::make_shared<Options>();
  root.Add("evaluate", "Apply a calibration to another session")
      .Option("--local", "", &options->local, "Compute here, from files, without a server")
      .Required("--calibration", "NAME|FILE", &options->calibration,
                "Such as ur10#1; with --local a file")
      .Required("--session", "UUID|FILE", &options->session,
                "A sealed session; with --local a session file")
      .Option("--robot", "FILE", &options->robot, "With --local: the robot file")
      .Option("--urdf-base", "LINK", &options->ends.base, kUrdfBaseHelp)
      .Option("--urdf-tip", "LINK", &options->ends.tip, kUrdfTipHelp)
      .Option("--observe", "KIND", &options->observe,
              "Use only the pose, point or point_axis; default: all there is")
      .Option("--euler", "CONVENTION", &options->euler,
              "With --local: read rx_,ry_,rz_ columns, such as xyz-intrinsic")
      .Option("--fixture", "FILE", &options->fixture,
              "With --local: places in which the tool was put; default: the calibration's")
      .Option("--feature-column", "COLUMN", &options->feature_column,
              "With --local: column with the name of the feature; default: the calibration's")
      .Footer(
          "Base and tool are fitted on the session's own rows.\n\nExamples:\n"
          "  truepose evaluate --calibration ur10#1 --session "
          "5f0c2c1e-8a53-4f0e-9a51-6f1f0f1f7a11\n"
          "  truepose evaluate --local --robot ur10.yaml --calibration ur10.calibration.json "
          "--session "
          "series_D.csv")
      .Run(Command::Reach::kRemote,
           [options](const Invocation& invocation) { return Evaluate(invocation, *options); });
}

}  // namespace truepose::cli
