#include "convert/prepared_calibration.h"

#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "convert/frames.h"
#include "convert/options.h"
#include "convert/robot.h"
#include "convert/unit_hints.h"
#include "convert/usable_readings.h"
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

// Of every session, named where there are several.
std::vector<std::string> HintsAt(const v1::CalibrationInput& input, const Robot& robot) {
  std::vector<std::string> hints;
  for (int i = 0; i < input.sessions_size(); ++i) {
    const std::string prefix =
        input.sessions_size() > 1 ? absl::StrCat("session ", i + 1, ": ") : "";
    for (const std::string& hint : UnitHints(input.nominal(), robot, input.sessions(i)))
      hints.push_back(prefix + hint);
  }
  return hints;
}

// The options' own faults and the robot's, at once.
absl::Status CheckInput(const v1::CalibrationInput& input) {
  FaultList faults;
  faults.AddAll(ValidateOptions(input.options()));
  faults.AddAll(ValidateNominal(input.nominal()), "nominal.");
  return faults.ToStatus();
}

}  // namespace

Hooks CoreHooks(const RunHooks& hooks) {
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

absl::StatusOr<PreparedCalibration> PrepareCalibration(const v1::CalibrationInput& input) {
  TRUEPOSE_RETURN_IF_ERROR(CheckInput(input));
  PreparedCalibration prepared;
  TRUEPOSE_ASSIGN_OR_RETURN(Robot robot, RobotFrom(input.nominal()));
  prepared.robot = std::make_unique<const Robot>(std::move(robot));
  prepared.sessions = SessionsOf(input);
  TRUEPOSE_ASSIGN_OR_RETURN(prepared.readings, ReadingsFrom(input.nominal(), *prepared.robot,
                                                            prepared.sessions, input.options()));
  TRUEPOSE_RETURN_IF_ERROR(
      CheckUsable(prepared.sessions, input.options(), prepared.readings.rows.size()));
  prepared.hints = HintsAt(input, *prepared.robot);
  prepared.warnings = prepared.hints;
  TRUEPOSE_RETURN_IF_ERROR(CheckLimits(input, &prepared.warnings));
  CalibrationProblem& problem = prepared.readings.problem;
  problem.robot = prepared.robot.get();
  TRUEPOSE_ASSIGN_OR_RETURN(problem.calibrates,
                            Roles(prepared.sessions, prepared.readings, input.options()));
  TRUEPOSE_ASSIGN_OR_RETURN(problem.X_FT_nominal,
                            NominalTool(input.nominal(), input.options().nominal_tool()));
  if (const auto earlier = EarlierTool(input.options())) problem.X_FT_nominal = earlier;
  TRUEPOSE_ASSIGN_OR_RETURN(prepared.options, CalibrateOptionsFrom(input.options()));
  problem.X_MB_known = KnownBases(input.options().prior_calibration(), problem.placements);
  return prepared;
}

}  // namespace truepose::convert
