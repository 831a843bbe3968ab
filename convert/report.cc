#include "convert/report.h"

#include <cmath>

#include "convert/digest.h"
#include "convert/frames.h"
#include "convert/report_parts.h"

namespace truepose::convert {
namespace {

v1::Statistics ToProto(const Statistics& statistics, double scale) {
  v1::Statistics message;
  message.set_mean(statistics.mean * scale);
  message.set_sd(statistics.sd * scale);
  message.set_rms(statistics.rms * scale);
  message.set_max(statistics.max * scale);
  return message;
}

v1::PoseStatistics StatisticsToProto(const std::vector<PoseError>& errors) {
  const PoseStatistics statistics = PoseStatisticsOf(errors);
  v1::PoseStatistics message;
  *message.mutable_position_mm() = ToProto(statistics.position_m, kMmPerM);
  if (statistics.has_rotation)
    *message.mutable_rotation_deg() = ToProto(statistics.rotation_rad, kDegPerRad);
  return message;
}

v1::ParameterGroup GroupToProto(ParameterGroup group) {
  if (group == ParameterGroup::kBase) return v1::BASE;
  if (group == ParameterGroup::kInstrument) return v1::INSTRUMENT;
  return group == ParameterGroup::kTool ? v1::TOOL : v1::INTERNAL;
}

// Coordinate 0..5 of a frame: position, then rotation vector.
double Coordinate(const Pose& X, int index) {
  return index < 3 ? X.p(index) : LogRotation<double>(X.R)(index - 3);
}

struct NominalAndIdentified {
  double nominal, identified;
};

// Values of a candidate of the calibration part. Corrections of frames are shown as coordinates of
// the frame itself.
NominalAndIdentified ValuesOf(const CalibrationResult& result, int candidate,
                              const Pose& X_FT_nominal) {
  const Estimate& estimate = result.identification.estimate;
  const int bases = static_cast<int>(estimate.X_MB.size()),
            tools = static_cast<int>(estimate.X_FT.size());
  const int frame = candidate / kFrameParameters, index = candidate % kFrameParameters;
  if (frame < bases) return {0, Coordinate(estimate.X_MB[frame], index)};
  if (frame < bases + tools)
    return {Coordinate(X_FT_nominal, index), Coordinate(estimate.X_FT[frame - bases], index)};
  const int rest = candidate - kFrameParameters * (bases + tools),
            offsets = static_cast<int>(estimate.offsets.size());
  return {0, rest < offsets ? estimate.offsets(rest) : estimate.lambda(rest - offsets)};
}

// Variances of the values as they are shown. Corrections of a frame's rotation are turns about the
// axes of its base, shown is the rotation vector r of the whole: d r = J_l^-1(r) d, J_l^-1(r) =
// J_r^-1(-r).
Eigen::VectorXd ShownVariances(const CalibrationResult& result) {
  const std::vector<int>& active = result.identification.set.active;
  const Eigen::MatrixXd& covariance = result.identification.covariance;
  Eigen::VectorXd variances = covariance.diagonal();
  const size_t frames =
      result.identification.estimate.X_MB.size() + result.identification.estimate.X_FT.size();
  const int first_of_offsets = kFrameParameters * static_cast<int>(frames);
  for (size_t i = 0; i + 2 < active.size() && i + 2 < static_cast<size_t>(covariance.rows()); ++i) {
    const bool rotation = active[i] < first_of_offsets && active[i] % kFrameParameters == 3 &&
                          active[i + 2] == active[i] + 2;
    if (!rotation) continue;
    Eigen::Vector3d r;
    for (int k = 0; k < 3; ++k) r(k) = ValuesOf(result, active[i] + k, Pose{}).identified;
    const Eigen::Matrix3d J = RightJacobianInverse(-r);
    const auto at = static_cast<Eigen::Index>(i);
    variances.segment<3>(at) = (J * covariance.block<3, 3>(at, at) * J.transpose()).diagonal();
  }
  return variances;
}

// What an internal parameter was before: of the earlier calibration in a partial recalibration.
double BeforeOf(const CalibrationResult& result, const Parameter& parameter, double nominal) {
  if (!result.change || parameter.group != ParameterGroup::kInternal) return nominal;
  return result.before.estimate.lambda(*result.model.parameters.Find(parameter.name));
}

void AddValue(const CalibrationResult& result, int candidate, const Pose& X_FT_nominal,
              std::optional<double> variance, v1::ParameterReport* report) {
  const Parameter& parameter = result.candidates[candidate];
  const double scale = ScaleOf(parameter.unit);
  const auto [nominal, identified] = ValuesOf(result, candidate, X_FT_nominal);
  v1::ParameterValue* value = report->add_values();
  value->set_name(parameter.name);
  value->set_nominal(BeforeOf(result, parameter, nominal) * scale);
  value->set_identified(identified * scale);
  if (variance) value->set_sd(std::sqrt(*variance) * scale);
  value->set_unit(NameOf(parameter.unit));
  value->set_group(GroupToProto(parameter.group));
}

// The identified parameters, then those that are held with the uncertainty of an earlier
// calibration: `identified` counts the former, the covariance is of all.
v1::ParameterReport ParametersOf(const CalibrationResult& result, const Pose& X_FT_nominal) {
  v1::ParameterReport report;
  const std::vector<int>& active = result.identification.set.active;
  const Eigen::VectorXd variances = ShownVariances(result);
  for (size_t i = 0; i < active.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(i);
    AddValue(result, active[i], X_FT_nominal,
             k < variances.size() ? std::optional(variances(k)) : std::nullopt, &report);
  }
  for (size_t i = 0; result.change && i < result.change->held.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(active.size() + i);
    AddValue(result, result.change->held[i], X_FT_nominal, result.change->covariance(k, k),
             &report);
  }
  report.set_identified(static_cast<int>(active.size()));
  return report;
}

// model_sd is what stays unexplained: in joint space, where the weights have no s_model, by R.
v1::Summary SummaryOf(const Identification& identification) {
  const ModelError unexplained = UnexplainedOf(identification);
  v1::Summary summary;
  summary.set_termination(Name(identification.summary.termination));
  summary.set_iterations(identification.summary.iterations);
  summary.set_initial_cost(identification.summary.initial_cost);
  summary.set_final_cost(identification.summary.final_cost);
  summary.set_residuals(identification.rows);
  summary.set_rank(static_cast<int>(identification.set.active.size()));
  summary.set_condition(identification.set.condition);
  summary.set_weighted_residual_variance(identification.weighted_residual_variance);
  summary.set_model_sd_position_mm(unexplained.position_sd_m * kMmPerM);
  summary.set_model_sd_rotation_deg(unexplained.rotation_sd_rad * kDegPerRad);
  summary.set_message(identification.summary.message);
  return summary;
}

void AddRedundancies(const CalibrationResult& result, v1::CalibrationReport* report) {
  for (const NullRelation& relation : result.identification.set.redundancies) {
    v1::Redundancy* redundancy = report->add_redundancies();
    redundancy->set_dropped(result.candidates[relation.dropped].name);
    redundancy->set_relation(RelationText(relation, result.candidates));
    redundancy->set_reason(ReasonText(relation, result.candidates));
    redundancy->set_structural(relation.structural);
  }
}

v1::FrameEstimate FrameOf(const std::string& label, v1::ParameterGroup group, const Pose& X,
                          FittedOn fitted_on) {
  v1::FrameEstimate frame;
  frame.set_name(label);
  frame.set_group(group);
  *frame.mutable_pose() = convert::ToProto(X);
  frame.set_fitted_on(fitted_on == FittedOn::kCalibrationRows ? "calibration rows"
                                                              : "its own rows");
  return frame;
}

}  // namespace

v1::SetReport SetReportOf(const SetResult& set, const std::vector<RowOf>& rows) {
  v1::SetReport report;
  report.set_poses(static_cast<int>(set.before.size()));
  *report.mutable_before() = StatisticsToProto(set.before);
  *report.mutable_after() = StatisticsToProto(set.after);
  std::vector<std::pair<int, int>> selected;
  for (const PoseError& error : set.before)
    selected.emplace_back(rows[error.id].session, rows[error.id].row);
  report.set_digest(RowsDigest(selected));
  return report;
}

std::vector<v1::RowResidual> ResidualsOf(const SetResult& complete, const std::vector<RowOf>& rows,
                                         const std::vector<bool>& calibrates) {
  std::vector<v1::RowResidual> residuals(complete.before.size());
  for (size_t i = 0; i < residuals.size(); ++i) {
    const PoseError &before = complete.before[i], &after = complete.after[i];
    residuals[i].set_session(rows[before.id].session);
    residuals[i].set_row(rows[before.id].row);
    residuals[i].set_control(!calibrates[before.id]);
    residuals[i].set_before_position_mm(before.position_m * kMmPerM);
    residuals[i].set_after_position_mm(after.position_m * kMmPerM);
    if (before.rotation_rad < 0) continue;
    residuals[i].set_before_rotation_deg(before.rotation_rad * kDegPerRad);
    residuals[i].set_after_rotation_deg(after.rotation_rad * kDegPerRad);
  }
  return residuals;
}

std::vector<v1::FrameEstimate> FramesOf(const Estimate& estimate,
                                        const std::vector<std::string>& placements,
                                        const std::vector<std::string>& targets,
                                        const std::vector<FittedOn>& base,
                                        const std::vector<FittedOn>& tool) {
  std::vector<v1::FrameEstimate> frames;
  for (size_t i = 0; i < placements.size(); ++i) {
    frames.push_back(FrameOf(placements[i], v1::BASE, estimate.X_MB[i], base[i]));
  }
  for (size_t i = 0; i < targets.size(); ++i) {
    frames.push_back(FrameOf(targets[i], v1::TOOL, estimate.X_FT[i], tool[i]));
  }
  return frames;
}

v1::CalibrationReport ReportOf(const CalibrationResult& result, const ReadingsProblem& readings,
                               const std::optional<Pose>& X_FT_nominal) {
  v1::CalibrationReport report;
  report.set_model(result.model.kind);
  report.set_convention(result.model.convention);
  *report.mutable_parameters() = ParametersOf(result, X_FT_nominal.value_or(Pose{}));
  *report.mutable_sets()->mutable_calibration() = SetReportOf(result.calibration, readings.rows);
  *report.mutable_sets()->mutable_control() = SetReportOf(result.control, readings.rows);
  *report.mutable_sets()->mutable_complete() = SetReportOf(result.complete, readings.rows);
  AddRedundancies(result, &report);
  report.set_verdict(Name(result.verdict.decision));
  for (const std::string& reason : result.verdict.reasons) report.add_verdict_reasons(reason);
  *report.mutable_summary() = SummaryOf(result.identification);
  for (v1::FrameEstimate& frame :
       FramesOf(result.after_frames, readings.problem.placements, readings.problem.targets,
                result.base_fitted_on, result.tool_fitted_on)) {
    *report.add_frames() = std::move(frame);
  }
  FillFindings(result, readings, &report);
  return report;
}

void FillParameters(const CalibrationResult& result, v1::Calibration* calibration) {
  for (int i = 0; i < result.model.parameters.size(); ++i) {
    v1::InternalParameter* parameter = calibration->add_internal_parameters();
    parameter->set_name(result.model.parameters[i].name);
    parameter->set_value(result.identification.estimate.lambda(i));
  }
  const Eigen::MatrixXd& covariance =
      result.change ? result.change->covariance : result.identification.covariance;
  for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
    for (Eigen::Index j = 0; j < covariance.cols(); ++j)
      calibration->add_covariance(covariance(i, j));
  }
}

}  // namespace truepose::convert
