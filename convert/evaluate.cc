#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "convert/calibrated_model.h"
#include "convert/frames.h"
#include "convert/readings.h"
#include "convert/report.h"
#include "convert/robot.h"
#include "convert/run.h"
#include "convert/torques.h"
#include "convert/usable_readings.h"
#include "core/base/status_macros.h"

namespace truepose::convert {
namespace {

v1::Evaluation MessageOf(const EvaluationResult& result, const ReadingsProblem& readings) {
  v1::Evaluation evaluation;
  *evaluation.mutable_set() = SetReportOf(result.set, readings.rows);
  const CalibrationProblem& problem = readings.problem;
  const std::vector<FittedOn> base(problem.placements.size(), FittedOn::kOwnRows);
  const std::vector<FittedOn> tool(problem.targets.size(), FittedOn::kOwnRows);
  for (v1::FrameEstimate& frame :
       FramesOf(result.after, problem.placements, problem.targets, base, tool)) {
    *evaluation.add_frames() = std::move(frame);
  }
  const std::vector<bool> control(problem.readings.size(), false);
  for (v1::RowResidual& residual : ResidualsOf(result.set, readings.rows, control)) {
    *evaluation.add_residuals() = std::move(residual);
  }
  for (const std::string& warning : readings.warnings) evaluation.add_warnings(warning);
  return evaluation;
}

// Parameters fit the joints that they were found with, offsets above all: "measured" or
// "commanded", "" where the calibration was made with either, as rows had them.
std::string JointsOf(const v1::Calibration& calibration) {
  const std::string& asked = calibration.options().joints();
  const std::string& used = calibration.report().joints_used();
  if (asked == "measured" || asked == "commanded") return asked;
  return asked == "both" || used == "commanded" ? used : "";
}

// The session's joints of that source; where it has none, those that it has, with a warning.
std::string JointsFor(const v1::Calibration& calibration, const v1::SessionInput& session,
                      std::string* warning) {
  const std::string joints = JointsOf(calibration);
  if (joints.empty()) return "";
  const auto& rows = session.readings();
  const bool there = std::any_of(rows.begin(), rows.end(), [&](const v1::Reading& row) {
    return !(joints == "measured" ? row.joints_measured() : row.joints_commanded()).empty();
  });
  if (there) return joints;
  *warning = absl::StrCat("the calibration was made with ", joints,
                          " joints, which this session does not have: the others are used");
  return "";
}

// How the calibration's sessions were read, for readings of the same kind: a fixture counts where
// the session's rows name its features.
v1::CalibrationOptions OptionsOf(const v1::Calibration& calibration,
                                 const v1::SessionInput& session, v1::Observe observe,
                                 std::string* warning) {
  v1::CalibrationOptions options;
  options.set_observe(observe);
  options.set_joints(JointsFor(calibration, session, warning));
  const std::string& column = calibration.options().feature_column();
  bool in_features = false;
  for (const v1::Reading& reading : session.readings())
    in_features = in_features || !reading.feature().empty();
  for (const std::string& extra : session.session().extra_columns())
    in_features = in_features || (!column.empty() && extra == column);
  if (!in_features || !calibration.options().has_fixture()) return options;
  *options.mutable_fixture() = calibration.options().fixture();
  options.set_feature_column(column);
  *options.mutable_joint_sd() = calibration.options().joint_sd();
  return options;
}

}  // namespace

absl::StatusOr<v1::Evaluation> RunEvaluation(const v1::Nominal& nominal,
                                             const v1::Calibration& calibration,
                                             const v1::SessionInput& session, v1::Observe observe) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Robot robot, RobotFrom(nominal));
  TRUEPOSE_ASSIGN_OR_RETURN(const CalibratedModel calibrated,
                            CalibratedModelFrom(robot, calibration));
  std::string warning;
  const v1::CalibrationOptions options = OptionsOf(calibration, session, observe, &warning);
  TRUEPOSE_ASSIGN_OR_RETURN(ReadingsProblem readings,
                            ReadingsFrom(nominal, robot, {&session}, options));
  if (!warning.empty()) readings.warnings.push_back(warning);
  TRUEPOSE_RETURN_IF_ERROR(CheckUsable({&session}, options, readings.rows.size()));
  TRUEPOSE_RETURN_IF_ERROR(CheckTorquesOfReadings(calibrated, readings.problem.readings));
  readings.problem.robot = &robot;
  if (nominal.tools_size() > 0) readings.problem.X_FT_nominal = PoseFrom(nominal.tools(0).pose());
  TRUEPOSE_ASSIGN_OR_RETURN(
      const EvaluationResult result,
      Evaluate(readings.problem, calibrated.model, calibrated.lambda, {}, {}));
  v1::Evaluation evaluation = MessageOf(result, readings);
  evaluation.set_calibration(calibration.name());
  evaluation.set_session(session.session().name());
  const auto& rows = session.readings();
  for (const std::string& warning : LimitWarnings(nominal, {rows.begin(), rows.end()}))
    evaluation.add_warnings(warning);
  return evaluation;
}

}  // namespace truepose::convert
