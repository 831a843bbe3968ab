#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "convert/digest.h"
#include "convert/frames.h"
#include "convert/options.h"
#include "convert/readings.h"
#include "convert/repeatability.h"
#include "convert/report.h"
#include "convert/robot.h"
#include "convert/run.h"
#include "core/assessment/split.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::convert {
namespace {

using Sessions = std::vector<const v1::SessionInput*>;

Sessions SessionsOf(const v1::CalibrationInput& input) {
  Sessions sessions;
  for (const v1::SessionInput& session : input.sessions()) sessions.push_back(&session);
  return sessions;
}

Hooks HooksFrom(const RunHooks& hooks) {
  Hooks core;
  core.is_cancelled = hooks.is_cancelled;
  if (!hooks.on_progress) return core;
  core.on_progress = [on_progress = hooks.on_progress](const Progress& progress) {
    v1::JobProgress message;
    message.set_stage(progress.stage);
    message.set_fraction(progress.fraction);
    message.set_iteration(progress.iteration);
    message.set_cost(progress.cost);
    on_progress(message);
  };
  return core;
}

// The tool that the target is near to: the one named, else the robot file's first as a mere start
// value.
absl::StatusOr<std::optional<Pose>> NominalTool(const v1::Nominal& nominal,
                                                const std::string& name) {
  if (name.empty()) {
    if (nominal.tools_size() == 0) return std::nullopt;
    return PoseFrom(nominal.tools(0).pose());
  }
  TRUEPOSE_ASSIGN_OR_RETURN(const Pose X_FT, ToolByName(nominal, name, "options.nominal_tool"));
  return X_FT;
}

// Base frames of an earlier calibration, by the names of their placements.
std::vector<std::optional<Pose>> KnownBases(const v1::PriorCalibration& prior,
                                            const std::vector<std::string>& placements) {
  std::vector<std::optional<Pose>> known(placements.size());
  for (const v1::FrameEstimate& frame : prior.frames()) {
    for (size_t i = 0; i < placements.size(); ++i) {
      if (frame.group() == v1::BASE && frame.name() == placements[i])
        known[i] = PoseFrom(frame.pose());
    }
  }
  return known;
}

// The earlier calibration's target, for calibrate = base without a tool that is named.
std::optional<Pose> EarlierTool(const v1::CalibrationOptions& options) {
  if (options.calibrate() != "base" || !options.nominal_tool().empty()) return std::nullopt;
  for (const v1::FrameEstimate& frame : options.prior_calibration().frames())
    if (frame.group() == v1::TOOL) return PoseFrom(frame.pose());
  return std::nullopt;
}

// Roles of the usable readings, from the split of all rows.
absl::StatusOr<std::vector<bool>> Roles(const Sessions& sessions, const ReadingsProblem& readings,
                                        const v1::CalibrationOptions& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Split split, ParseSplit(options.split()));
  std::vector<std::string> groups, values;
  int rows = 0;
  for (const v1::SessionInput* session : sessions) rows += session->readings_size();
  if (!options.group_column().empty()) {
    TRUEPOSE_ASSIGN_OR_RETURN(
        groups, ColumnValues(sessions, options.group_column(), "options.group_column"));
  }
  if (split.rule == SplitRule::kColumn) {
    TRUEPOSE_ASSIGN_OR_RETURN(values, ColumnValues(sessions, split.column, "options.split"));
  }
  TRUEPOSE_ASSIGN_OR_RETURN(const std::vector<bool> all, ApplySplit(split, rows, groups, values));
  std::vector<bool> usable;
  for (int position : readings.position) usable.push_back(all[position]);
  return usable;
}

absl::Status CheckLimits(const v1::CalibrationInput& input, std::vector<std::string>* warnings) {
  FaultList faults;
  for (int i = 0; i < input.sessions_size(); ++i) {
    const auto& readings = input.sessions(i).readings();
    for (const std::string& warning :
         LimitWarnings(input.nominal(), {readings.begin(), readings.end()})) {
      const std::string prefix =
          input.sessions_size() > 1 ? absl::StrCat("session ", i + 1, ": ") : "";
      warnings->push_back(prefix + warning);
      faults.Add(absl::StrCat("sessions[", i, "].readings"), warning,
                 "joints within their limits (strict_limits)");
    }
  }
  return input.options().strict_limits() ? faults.ToStatus() : absl::OkStatus();
}

void WarnOfFrames(v1::CalibrationReport* report) {
  for (const v1::FrameEstimate& frame : report->frames()) {
    if (frame.fitted_on() != "its own rows") continue;
    report->add_warnings(
        absl::StrCat(frame.group() == v1::BASE ? "placement '" : "target '", frame.name(),
                     "' has no calibration row: its frame is fitted on its own control rows"));
  }
}

v1::Calibration MessageOf(const v1::CalibrationInput& input, const CalibrationResult& result,
                          const ReadingsProblem& readings, const std::optional<Pose>& X_FT) {
  v1::Calibration calibration;
  calibration.set_nominal_revision(input.nominal_revision());
  for (const v1::SessionInput& session : input.sessions())
    calibration.add_sessions(session.session().name());
  FillParameters(result, &calibration);
  *calibration.mutable_report() = ReportOf(result, readings, X_FT);
  *calibration.mutable_options() = input.options();
  for (v1::RowResidual& residual :
       ResidualsOf(result.complete, readings.rows, readings.problem.calibrates)) {
    *calibration.add_residuals() = std::move(residual);
  }
  calibration.set_digest(
      CalibrationDigest(result.model.convention, NominalDigest(input.nominal()), calibration));
  return calibration;
}

// Rows that were used without a temperature, where the drift with it was identified.
int WithoutTemperature(const v1::CalibrationInput& input, const ReadingsProblem& readings) {
  std::set<std::pair<int, int>> used;
  for (const RowOf& row : readings.rows) used.emplace(row.session, row.row);
  int count = 0;
  for (int s = 0; s < input.sessions_size(); ++s)
    for (const v1::Reading& reading : input.sessions(s).readings())
      count += !reading.has_temperature_c() && used.contains({s, reading.row()});
  return count;
}

void WarnOfTemperatures(const v1::CalibrationInput& input, const ReadingsProblem& readings,
                        v1::CalibrationReport* report) {
  const auto& effects = report->effects();
  if (std::find(effects.begin(), effects.end(), Name(EffectGroup::kTemperature)) == effects.end())
    return;
  const int count = WithoutTemperature(input, readings);
  if (count == 0) return;
  report->add_warnings(absl::StrCat(count, count == 1 ? " row has" : " rows have",
                                    " no temperature: the effect `temperature` takes the mean of "
                                    "the session for it"));
}

void FillReport(const v1::CalibrationInput& input, const ReadingsProblem& readings,
                const std::vector<std::string>& warnings, v1::CalibrationReport* report) {
  report->set_split(input.options().split());
  report->set_estimator(input.options().estimator().empty() ? "levenberg_marquardt"
                                                            : input.options().estimator());
  report->set_joints_used(readings.joints_used);
  for (const std::string& warning : readings.warnings) report->add_warnings(warning);
  for (const std::string& warning : warnings) report->add_warnings(warning);
  WarnOfFrames(report);
  WarnOfTemperatures(input, readings, report);
}

// The options' own faults and the robot's, at once.
absl::Status CheckInput(const v1::CalibrationInput& input) {
  FaultList faults;
  faults.AddAll(ValidateOptions(input.options()));
  faults.AddAll(ValidateNominal(input.nominal()), "nominal.");
  return faults.ToStatus();
}

absl::StatusOr<v1::Calibration> RunOnce(const v1::CalibrationInput& input, const RunHooks& hooks) {
  TRUEPOSE_RETURN_IF_ERROR(CheckInput(input));
  TRUEPOSE_ASSIGN_OR_RETURN(const Robot robot, RobotFrom(input.nominal()));
  const Sessions sessions = SessionsOf(input);
  TRUEPOSE_ASSIGN_OR_RETURN(ReadingsProblem readings,
                            ReadingsFrom(input.nominal(), robot, sessions, input.options()));
  std::vector<std::string> warnings;
  TRUEPOSE_RETURN_IF_ERROR(CheckLimits(input, &warnings));
  readings.problem.robot = &robot;
  TRUEPOSE_ASSIGN_OR_RETURN(readings.problem.calibrates,
                            Roles(sessions, readings, input.options()));
  TRUEPOSE_ASSIGN_OR_RETURN(readings.problem.X_FT_nominal,
                            NominalTool(input.nominal(), input.options().nominal_tool()));
  if (const auto earlier = EarlierTool(input.options())) readings.problem.X_FT_nominal = earlier;
  TRUEPOSE_ASSIGN_OR_RETURN(const CalibrateOptions options, CalibrateOptionsFrom(input.options()));
  readings.problem.X_MB_known =
      KnownBases(input.options().prior_calibration(), readings.problem.placements);
  const Hooks core_hooks = HooksFrom(hooks);
  TRUEPOSE_ASSIGN_OR_RETURN(const CalibrationResult result,
                            Calibrate(readings.problem, options, core_hooks));
  v1::Calibration calibration = MessageOf(
      input, result, readings,
      input.options().nominal_tool().empty() ? std::nullopt : readings.problem.X_FT_nominal);
  FillReport(input, readings, warnings, calibration.mutable_report());
  FillRepeatability(sessions, readings, result, calibration.mutable_report());
  return calibration;
}

// RMS position after calibration: of the control set, where there is one.
double JudgedRms(const v1::Calibration& calibration) {
  const v1::Sets& sets = calibration.report().sets();
  const v1::SetReport& set = sets.control().poses() > 0 ? sets.control() : sets.calibration();
  return set.after().position_mm().rms();
}

// Progress of one of two runs.
RunHooks HalfOf(const RunHooks& hooks, double from) {
  RunHooks half = hooks;
  if (!hooks.on_progress) return half;
  half.on_progress = [on_progress = hooks.on_progress, from](const v1::JobProgress& progress) {
    v1::JobProgress moved = progress;
    moved.set_fraction(from + progress.fraction() / 2);
    on_progress(moved);
  };
  return half;
}

// With measured and with commanded joints; the better one is the result and says so.
absl::StatusOr<v1::Calibration> RunBoth(const v1::CalibrationInput& input, const RunHooks& hooks) {
  v1::CalibrationInput one = input;
  one.mutable_options()->set_joints("measured");
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Calibration measured, RunOnce(one, HalfOf(hooks, 0)));
  one.mutable_options()->set_joints("commanded");
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Calibration commanded, RunOnce(one, HalfOf(hooks, 0.5)));
  const bool measured_is_better = JudgedRms(measured) <= JudgedRms(commanded);
  v1::Calibration best = measured_is_better ? measured : commanded;
  best.mutable_report()->set_joints_compared(absl::StrFormat(
      "%s joints fit better: RMS position %.3f mm with measured, %.3f mm with commanded joints",
      measured_is_better ? "measured" : "commanded", JudgedRms(measured), JudgedRms(commanded)));
  return best;
}

}  // namespace

absl::StatusOr<v1::Calibration> RunCalibration(const v1::CalibrationInput& input,
                                               const RunHooks& hooks) {
  return input.options().joints() == "both" ? RunBoth(input, hooks) : RunOnce(input, hooks);
}

}  // namespace truepose::convert
