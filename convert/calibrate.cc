#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/time/time.h"
#include "convert/digest.h"
#include "convert/prepared_calibration.h"
#include "convert/repeatability.h"
#include "convert/report.h"
#include "convert/run.h"
#include "convert/torques.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::convert {
namespace {

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
  ShowEarlierFrames(input.options().prior_calibration(), calibration.mutable_report());
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

// Measured joints are used wherever there are any (readings.h).
std::string ComparedText(const JointComparison& joints) {
  const bool other = joints.other_rms_m < joints.used_rms_m;
  return absl::StrFormat(
      "%s joints fit better: RMS position of %d calibration rows %.3f mm with measured, %.3f mm "
      "with commanded joints%s",
      other ? "commanded" : "measured", joints.readings, kMmPerM * joints.used_rms_m,
      kMmPerM * joints.other_rms_m,
      other ? "; this result is of the measured ones, --joints commanded takes the others" : "");
}

// A measured pose is as traceable as the instrument was when it was measured.
void WarnOfCertificates(const v1::CalibrationInput& input, v1::CalibrationReport* report) {
  for (const v1::SessionInput& each : input.sessions()) {
    const v1::Session& session = each.session();
    if (!session.has_certificate_expired_time()) continue;
    const absl::Time expired = absl::FromUnixSeconds(session.certificate_expired_time().seconds());
    report->add_warnings(absl::StrCat(
        "the certificate of ", session.instrument(), " had expired on ",
        absl::FormatTime("%Y-%m-%d", expired, absl::UTCTimeZone()), " when ", session.name(),
        " was sealed: its measured poses are not traceable; have the instrument checked"));
  }
}

// The chapter's mean error is one of positions.
void WarnOfObjective(const v1::CalibrationInput& input, v1::CalibrationReport* report) {
  const v1::PoseStatistics& after = report->sets().calibration().after();
  if (input.options().objective() != "e_op" || !after.has_rotation_deg()) return;
  report->add_warnings(absl::StrFormat(
      "objective e_op fits positions alone: orientations were measured and are left %.3f deg RMS "
      "off; compensate positions only, or use least_squares",
      after.rotation_deg().rms()));
}

void FillReport(const v1::CalibrationInput& input, const CalibrationResult& result,
                const ReadingsProblem& readings, const std::vector<std::string>& warnings,
                v1::CalibrationReport* report) {
  report->set_split(input.options().split());
  report->set_estimator(input.options().estimator().empty() ? "levenberg_marquardt"
                                                            : input.options().estimator());
  report->set_joints_used(readings.joints_used);
  if (result.joints) report->set_joints_compared(ComparedText(*result.joints));
  for (const std::string& warning : readings.warnings) report->add_warnings(warning);
  for (const std::string& warning : warnings) report->add_warnings(warning);
  WarnOfFrames(report);
  WarnOfTemperatures(input, readings, report);
  WarnOfObjective(input, report);
  WarnOfCertificates(input, report);
}

// The faults of a run that failed, and what may be behind them.
absl::Status WithHints(const absl::Status& status, const std::vector<std::string>& hints) {
  if (hints.empty() || FaultsOf(status).empty()) return status;
  FaultList faults;
  faults.AddAll(status);
  for (const std::string& hint : hints)
    faults.Add("sessions", hint, "the units that the columns say");
  return faults.ToStatus(status.code());
}

absl::StatusOr<v1::Calibration> RunOnce(const v1::CalibrationInput& input, const RunHooks& hooks) {
  TRUEPOSE_ASSIGN_OR_RETURN(const PreparedCalibration prepared, PrepareCalibration(input));
  const ReadingsProblem& readings = prepared.readings;
  const absl::StatusOr<CalibrationResult> calibrated =
      Calibrate(readings.problem, prepared.options, CoreHooks(hooks));
  if (!calibrated.ok()) return WithHints(calibrated.status(), prepared.hints);
  const CalibrationResult& result = *calibrated;
  std::vector<std::string> warnings = prepared.warnings;
  if (const std::string warning = TorqueWarning(result.model); !warning.empty())
    warnings.push_back(warning);
  v1::Calibration calibration = MessageOf(
      input, result, readings,
      input.options().nominal_tool().empty() ? std::nullopt : readings.problem.X_FT_nominal);
  FillReport(input, result, readings, warnings, calibration.mutable_report());
  FillRepeatability(prepared.sessions, readings, result, calibration.mutable_report());
  return calibration;
}

// RMS position of the calibration rows: a choice by the control set would leave none to judge it.
double JudgedRms(const v1::Calibration& calibration) {
  return calibration.report().sets().calibration().after().position_mm().rms();
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
      "%s joints fit better: RMS position of the calibration rows %.3f mm with measured, %.3f mm "
      "with commanded joints",
      measured_is_better ? "measured" : "commanded", JudgedRms(measured), JudgedRms(commanded)));
  return best;
}

}  // namespace

absl::StatusOr<v1::Calibration> RunCalibration(const v1::CalibrationInput& input,
                                               const RunHooks& hooks) {
  return input.options().joints() == "both" ? RunBoth(input, hooks) : RunOnce(input, hooks);
}

}  // namespace truepose::convert
