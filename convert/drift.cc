#include "convert/drift.h"

#include <algorithm>
#include <map>

#include "absl/strings/match.h"
#include "absl/strings/str_format.h"
#include "convert/calibrated_model.h"
#include "convert/frames.h"
#include "convert/held_frames.h"
#include "convert/readings.h"
#include "convert/report.h"
#include "convert/robot.h"
#include "core/base/status_macros.h"
#include "core/drift/drift_check.h"

namespace truepose::convert {
namespace {

bool NamesFeatures(const v1::SessionInput& session, const std::string& column) {
  for (const v1::Reading& reading : session.readings())
    if (!reading.feature().empty()) return true;
  for (const std::string& extra : session.session().extra_columns())
    if (!column.empty() && extra == column) return true;
  return false;
}

// How the calibration's own sessions were read.
v1::CalibrationOptions ReadingOptionsOf(const v1::Calibration& calibration,
                                        const v1::SessionInput& check) {
  const v1::CalibrationOptions& own = calibration.options();
  v1::CalibrationOptions options;
  options.set_observe(own.observe());
  *options.mutable_joint_sd() = own.joint_sd();
  options.set_joints(own.joints());
  if (own.joints() == "both")
    options.set_joints(absl::StartsWith(calibration.report().joints_used(), "commanded")
                           ? "commanded"
                           : "measured");
  if (!own.has_fixture() || !NamesFeatures(check, own.feature_column())) return options;
  *options.mutable_fixture() = own.fixture();
  options.set_feature_column(own.feature_column());
  options.set_pose_matching(own.pose_matching());
  return options;
}

// Candidates of the check beside the places of the same parameters in the calibration's covariance.
std::map<int, int> PlacesOf(const v1::CalibrationReport& report, const Problem& check,
                            const HeldFrames& held) {
  std::map<std::string, int> candidate_of;
  const auto add = [&](const v1::FrameEstimate* frame, int first) {
    if (frame == nullptr) return;
    for (const std::string& name : ParameterNamesOf(*frame, report)) candidate_of[name] = first++;
  };
  for (int i = 0; i < check.placement_count(); ++i) add(held.bases[i], check.FirstOfBase(i));
  for (int i = 0; i < check.target_count(); ++i) add(held.tools[i], check.FirstOfTool(i));
  for (int i = 0; i < check.model->parameters.size(); ++i)
    candidate_of[check.model->parameters[i].name] = check.FirstInternal() + i;
  std::map<int, int> places;
  for (int i = 0; i < report.parameters().values_size(); ++i) {
    const auto it = candidate_of.find(report.parameters().values(i).name());
    if (it != candidate_of.end()) places[it->second] = i;
  }
  return places;
}

// What the calibration before knew of parameters that this one held.
Eigen::MatrixXd EarlierCovariance(const v1::Calibration& calibration, const Problem& check) {
  const int n = check.CandidateCount();
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  const v1::PriorCalibration& prior = calibration.options().prior_calibration();
  const int k = prior.identified_size();
  if (k == 0 || prior.covariance_size() != k * k) return covariance;
  StoredCalibration stored;
  stored.identified = {prior.identified().begin(), prior.identified().end()};
  stored.covariance = Eigen::Map<const Eigen::MatrixXd>(prior.covariance().data(), k, k);
  const int internal = check.model->parameters.size();
  covariance.bottomRightCorner(internal, internal) =
      InternalCovariance(stored, check.model->parameters);
  return covariance;
}

Eigen::MatrixXd CovarianceOf(const v1::Calibration& calibration, const Problem& check,
                             const HeldFrames& held) {
  Eigen::MatrixXd covariance = EarlierCovariance(calibration, check);
  const int n = calibration.report().parameters().values_size();
  if (calibration.covariance_size() != n * n) return covariance;
  const std::map<int, int> places = PlacesOf(calibration.report(), check, held);
  for (const auto& [row, i] : places) {
    covariance.row(row).setZero();
    covariance.col(row).setZero();
  }
  for (const auto& [row, i] : places)
    for (const auto& [col, j] : places) covariance(row, col) = calibration.covariance(i * n + j);
  return covariance;
}

void Hold(const std::vector<const v1::FrameEstimate*>& frames, std::vector<Pose>* poses,
          std::vector<bool>* held) {
  for (const v1::FrameEstimate* frame : frames) {
    poses->push_back(frame == nullptr ? Pose{} : PoseFrom(frame->pose()));
    held->push_back(frame != nullptr);
  }
}

// @param readings, calibrated are pointed to by the result.
DriftProblem ProblemOf(const v1::Nominal& nominal, const v1::Calibration& calibration,
                       const Robot& robot, const CalibratedModel& calibrated,
                       const HeldFrames& held, const CalibrationProblem& readings) {
  DriftProblem problem;
  problem.robot = &robot;
  problem.check = {&calibrated.model, readings.readings, readings.placements, readings.targets,
                   readings.offsets};
  problem.active.lambda = calibrated.lambda;
  Hold(held.bases, &problem.active.X_MB, &problem.base_held);
  Hold(held.tools, &problem.active.X_FT, &problem.tool_held);
  problem.covariance = CovarianceOf(calibration, problem.check, held);
  const v1::Summary& summary = calibration.report().summary();
  problem.model_error = {summary.model_sd_position_mm() / kMmPerM,
                         summary.model_sd_rotation_deg() / kDegPerRad};
  problem.redundancy = std::max(0, summary.residuals() - summary.rank());
  if (nominal.tools_size() > 0) problem.X_FT_nominal = PoseFrom(nominal.tools(0).pose());
  return problem;
}

v1::DriftPart PartToProto(const DriftPart& part) {
  v1::DriftPart message;
  message.set_part(part.name);
  message.set_chi_square(part.chi_square);
  message.set_degrees_of_freedom(part.degrees_of_freedom);
  message.set_p_value(part.p_value);
  message.set_change_mm(part.change_m * kMmPerM);
  message.set_change_deg(part.change_rad * kDegPerRad);
  return message;
}

void FillStatistics(const Statistics& position_m, v1::Statistics* message) {
  message->set_mean(position_m.mean * kMmPerM);
  message->set_sd(position_m.sd * kMmPerM);
  message->set_rms(position_m.rms * kMmPerM);
  message->set_max(position_m.max * kMmPerM);
}

void FillLimit(double limit_mm, v1::DriftCheck* check) {
  check->set_limit_mm(limit_mm);
  const double rms_mm = check->position_mm().rms();
  check->set_limit_exceeded(limit_mm > 0 && rms_mm > limit_mm);
  if (limit_mm > 0)
    check->add_findings(absl::StrFormat("RMS position error %.3f mm is %s the limit of %.3f mm.",
                                        rms_mm, check->limit_exceeded() ? "beyond" : "within",
                                        limit_mm));
}

v1::DriftCheck MessageOf(const DriftCheckResult& result) {
  v1::DriftCheck check;
  check.set_poses(result.poses);
  FillStatistics(result.position_m, check.mutable_position_mm());
  check.set_chi_square(result.chi_square);
  check.set_degrees_of_freedom(result.degrees_of_freedom);
  check.set_p_value(result.p_value);
  check.set_changed(result.changed);
  check.set_attributed_to(result.attributed_to);
  for (const DriftPart& part : result.parts) *check.add_parts() = PartToProto(part);
  check.set_base_observable(result.base_observable);
  for (const std::string& finding : result.findings) check.add_findings(finding);
  return check;
}

}  // namespace

absl::StatusOr<v1::DriftCheck> RunDriftCheck(const v1::Nominal& nominal,
                                             const v1::Calibration& calibration,
                                             const std::vector<v1::Session>& sessions,
                                             const v1::SessionInput& check, double limit_mm) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Robot robot, RobotFrom(nominal));
  TRUEPOSE_ASSIGN_OR_RETURN(const CalibratedModel calibrated,
                            CalibratedModelFrom(robot, calibration));
  TRUEPOSE_ASSIGN_OR_RETURN(
      const ReadingsProblem readings,
      ReadingsFrom(nominal, robot, {&check}, ReadingOptionsOf(calibration, check)));
  const HeldFrames held = HeldFramesOf(calibration, sessions, check, readings.problem.placements,
                                       readings.problem.targets);
  TRUEPOSE_ASSIGN_OR_RETURN(
      const DriftCheckResult result,
      CheckDrift(ProblemOf(nominal, calibration, robot, calibrated, held, readings.problem)));
  v1::DriftCheck message = MessageOf(result);
  message.set_session(check.session().name());
  message.set_calibration(calibration.name());
  for (const std::string& warning : readings.warnings) message.add_findings(warning);
  FillLimit(limit_mm, &message);
  return message;
}

}  // namespace truepose::convert
