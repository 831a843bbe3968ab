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
double ValueIn(const Estimate& estimate, int candidate) {
  const int bases = static_cast<int>(estimate.X_MB.size()),
            tools = static_cast<int>(estimate.X_FT.size());
  const int frame = candidate / kFrameParameters, index = candidate % kFrameParameters;
  if (frame < bases) return Coordinate(estimate.X_MB[frame], index);
  if (frame < bases + tools) return Coordinate(estimate.X_FT[frame - bases], index);
  const int rest = candidate - kFrameParameters * (bases + tools),
            offsets = static_cast<int>(estimate.offsets.size());
  return rest < offsets ? estimate.offsets(rest) : estimate.lambda(rest - offsets);
}

NominalAndIdentified ValuesOf(const CalibrationResult& result, int candidate,
                              const Pose& X_FT_nominal) {
  const Estimate& estimate = result.identification.estimate;
  const auto bases = static_cast<int>(estimate.X_MB.size());
  const int frame = candidate / kFrameParameters;
  const bool tool = frame >= bases && frame < bases + static_cast<int>(estimate.X_FT.size());
  const double nominal = tool ? Coordinate(X_FT_nominal, candidate % kFrameParameters) : 0;
  return {nominal, ValueIn(estimate, candidate)};
}

bool IsTurnOfFrame(const Parameter& parameter, int candidate) {
  const bool frame =
      parameter.group == ParameterGroup::kBase || parameter.group == ParameterGroup::kTool;
  return frame && candidate % kFrameParameters >= 3;
}

// Derivative of a shown rotation coordinate by the active candidates. Corrections of a frame's
// rotation are turns about the axes of its base, shown is the rotation vector r of the whole:
// d r = J_l^-1(r) d, J_l^-1(r) = J_r^-1(-r). Turns that are held have no part in it.
Eigen::RowVectorXd ShownByActive(const CalibrationResult& result, int candidate) {
  const int axis = candidate % kFrameParameters - 3, first = candidate - axis;
  Eigen::Vector3d r;
  for (int k = 0; k < 3; ++k) r(k) = ValuesOf(result, first + k, Pose{}).identified;
  const Eigen::RowVector3d J = RightJacobianInverse(-r).row(axis);
  const std::vector<int>& active = result.identification.set.active;
  Eigen::RowVectorXd derivative =
      Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(active.size()));
  for (size_t i = 0; i < active.size(); ++i) {
    const int turn = active[i] - first;
    if (turn >= 0 && turn < 3) derivative(static_cast<Eigen::Index>(i)) = J(turn);
  }
  return derivative;
}

// Variances of the values as they are shown.
Eigen::VectorXd ShownVariances(const CalibrationResult& result) {
  const Eigen::MatrixXd& covariance = result.identification.covariance;
  Eigen::VectorXd variances = covariance.diagonal();
  for (Eigen::Index i = 0; i < variances.size(); ++i) {
    const int candidate = result.identification.set.active[static_cast<size_t>(i)];
    if (!IsTurnOfFrame(result.candidates[candidate], candidate)) continue;
    const Eigen::RowVectorXd derivative = ShownByActive(result, candidate);
    variances(i) = derivative * covariance * derivative.transpose();
  }
  return variances;
}

// What a parameter was before: in a partial recalibration that of the earlier calibration, of
// frames those which these readings give with it; else nominal.
double BeforeOf(const CalibrationResult& result, int candidate, double nominal) {
  if (!result.change) return nominal;
  const Parameter& parameter = result.candidates[candidate];
  if (parameter.group != ParameterGroup::kInternal)
    return ValueIn(result.before.estimate, candidate);
  return result.before.estimate.lambda(*result.model.parameters.Find(parameter.name));
}

// model_sd is what stays unexplained: in joint space, where the weights have no s_model, by R.
v1::Summary SummaryOf(const CalibrationResult& result) {
  const Identification& identification = result.identification;
  v1::Summary summary;
  summary.set_termination(Name(identification.summary.termination));
  summary.set_iterations(identification.summary.iterations);
  summary.set_initial_cost(identification.summary.initial_cost);
  summary.set_final_cost(identification.summary.final_cost);
  summary.set_residuals(identification.rows);
  summary.set_rank(static_cast<int>(identification.set.active.size()));
  summary.set_condition(identification.set.condition);
  summary.set_weighted_residual_variance(identification.weighted_residual_variance);
  const ModelError unexplained = UnexplainedOf(identification);
  summary.set_model_sd_position_mm(unexplained.position_sd_m * kMmPerM);
  // Where no rotation was measured there is nothing unexplained in it, only the start value.
  if (PoseStatisticsOf(result.calibration.after).has_rotation)
    summary.set_model_sd_rotation_deg(unexplained.rotation_sd_rad * kDegPerRad);
  summary.set_message(identification.summary.message);
  return summary;
}

void AddRedundancies(const CalibrationResult& result, v1::CalibrationReport* report) {
  for (const NullRelation& relation : result.identification.set.redundancies)
    *report->add_redundancies() = RedundancyOf(relation, result.candidates);
}

v1::FrameEstimate FrameOf(const std::string& label, v1::ParameterGroup group, const Pose& X,
                          FittedOn fitted_on) {
  v1::FrameEstimate frame;
  frame.set_name(label);
  frame.set_group(group);
  *frame.mutable_pose() = convert::ToProto(X);
  frame.set_fitted_on(fitted_on == FittedOn::kCalibrationRows ? kOnCalibrationRows
                                                              : "its own rows");
  return frame;
}

const v1::FrameEstimate* FrameNamed(const v1::PriorCalibration& earlier,
                                    const v1::FrameEstimate& frame) {
  for (const v1::FrameEstimate& known : earlier.frames()) {
    if (known.group() == frame.group() && known.name() == frame.name()) return &known;
  }
  return nullptr;
}

// How many frames of a group have parameters of their own: a label stands in names where there are
// several.
int FramesWithParameters(const v1::CalibrationReport& report, v1::ParameterGroup group) {
  int count = 0;
  for (const v1::FrameEstimate& frame : report.frames())
    count += frame.group() == group && frame.fitted_on() == kOnCalibrationRows;
  return count;
}

void AddValue(const CalibrationResult& result, int candidate, const Pose& X_FT_nominal,
              std::optional<double> variance, v1::ParameterReport* report) {
  const Parameter& parameter = result.candidates[candidate];
  const double scale = ScaleOf(parameter.unit);
  const auto [nominal, identified] = ValuesOf(result, candidate, X_FT_nominal);
  v1::ParameterValue* value = report->add_values();
  value->set_name(parameter.name);
  value->set_nominal(BeforeOf(result, candidate, nominal) * scale);
  value->set_identified(identified * scale);
  if (variance) value->set_sd(std::sqrt(*variance) * scale);
  value->set_unit(NameOf(parameter.unit));
  value->set_group(GroupToProto(parameter.group));
}

}  // namespace

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

void ShowEarlierFrames(const v1::PriorCalibration& earlier, v1::CalibrationReport* report) {
  if (!report->has_change()) return;
  for (const v1::FrameEstimate& frame : report->frames()) {
    const v1::FrameEstimate* known = FrameNamed(earlier, frame);
    if (known == nullptr || frame.fitted_on() != kOnCalibrationRows) continue;
    const std::string label =
        FramesWithParameters(*report, frame.group()) > 1 ? frame.name() : std::string();
    const auto group = frame.group() == v1::BASE ? ParameterGroup::kBase : ParameterGroup::kTool;
    for (int i = 0; i < kFrameParameters; ++i) {
      const Parameter parameter = FrameParameter(group, label, i);
      for (v1::ParameterValue& value : *report->mutable_parameters()->mutable_values()) {
        if (value.name() == parameter.name)
          value.set_nominal(Coordinate(PoseFrom(known->pose()), i) * ScaleOf(parameter.unit));
      }
    }
  }
}

v1::SetReport SetReportOf(const SetResult& set, const std::vector<RowOf>& rows) {
  v1::SetReport report;
  report.set_poses(UnitsOf(set.before).count);
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
  *report.mutable_summary() = SummaryOf(result);
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
