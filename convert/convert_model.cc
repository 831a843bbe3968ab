// A calibration expressed in another model.
#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "convert/calibrated_model.h"
#include "convert/digest.h"
#include "convert/frames.h"
#include "convert/report.h"
#include "convert/robot.h"
#include "convert/run.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/conversion/conversion_jacobian.h"
#include "core/models/build_model.h"

namespace truepose::convert {
namespace {

// m or rad: a parameter that moves by less than this over the whole uncertainty has not been
// identified.
constexpr double kNoDeviation = 1e-12;

constexpr char kOffset[] = "offset[";

// Frames, constants and parameters of a calibration, those beside its covariance.
struct Stored {
  Problem problem;
  Estimate estimate;
};

absl::StatusOr<Model> ModelNamed(const std::string& kind, const Robot& robot) {
  const std::vector<std::string>& kinds = ModelKinds();
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
    return FaultStatus("options.model", absl::StrCat("'", kind, "'"), absl::StrJoin(kinds, ", "));
  return BuildModel(kind, robot, ModelExtent::kInternal);
}

void AddEffectsOf(const v1::CalibrationReport& report, const Robot& robot, Model* to) {
  for (EffectGroup group : AllEffectGroups()) {
    for (const std::string& name : report.effects())
      if (Name(group) == name) AddEffects(robot, group, to);
  }
}

// "a" of offset[a].
void AddOffsets(const v1::CalibrationReport& report, Stored* stored) {
  std::vector<double> values;
  for (const v1::ParameterValue& value : report.parameters().values()) {
    const std::string& name = value.name();
    if (value.group() != v1::INSTRUMENT || !absl::StartsWith(name, kOffset)) continue;
    const size_t begin = sizeof(kOffset) - 1;
    stored->problem.offsets.push_back(name.substr(begin, name.size() - begin - 1));
    values.push_back(value.identified() / kMmPerM);
  }
  stored->estimate.offsets =
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

// @param identified only frames that calibration rows determined, as beside the covariance.
Stored StoredOf(const v1::CalibrationReport& report, const Model& model,
                const Eigen::VectorXd& lambda, bool identified) {
  Stored stored;
  stored.problem.model = &model;
  stored.estimate.lambda = lambda;
  for (const v1::FrameEstimate& frame : report.frames()) {
    if (identified && frame.fitted_on() != kOnCalibrationRows) continue;
    const bool base = frame.group() == v1::BASE;
    (base ? stored.problem.placements : stored.problem.targets).push_back(frame.name());
    (base ? stored.estimate.X_MB : stored.estimate.X_FT).push_back(PoseFrom(frame.pose()));
  }
  AddOffsets(report, &stored);
  return stored;
}

// Candidates of the values beside the covariance, in their order.
absl::StatusOr<std::vector<int>> ColumnsOf(const v1::Calibration& calibration,
                                           const ParameterSet& candidates) {
  FaultList faults;
  std::vector<int> columns;
  const auto& values = calibration.report().parameters().values();
  for (int i = 0; i < values.size(); ++i) {
    if (const auto index = candidates.Find(values[i].name())) {
      columns.push_back(*index);
    } else {
      faults.Add(absl::StrCat("calibration.report.parameters.values[", i, "].name"),
                 absl::StrCat("'", values[i].name(), "'"), "a parameter or frame of the report");
    }
  }
  const int n = values.size();
  if (calibration.covariance_size() != n * n)
    faults.Add("calibration.covariance", absl::StrCat(calibration.covariance_size(), " values"),
               absl::StrCat(n, " x ", n, ", a row for each identified parameter"));
  if (!faults.empty()) return faults.ToStatus();
  return columns;
}

// Points show no rotation of their target; a conversion that turns the flange does not change that.
bool IsUnseenRotation(int candidate, const Problem& problem, const std::vector<int>& columns) {
  if (candidate >= problem.FirstOfOffsets() || candidate % kFrameParameters < 3) return false;
  const int frame = candidate / kFrameParameters;
  return std::none_of(columns.begin(), columns.end(), [&](int column) {
    return column / kFrameParameters == frame && column % kFrameParameters >= 3;
  });
}

// The covariance in the other model, with the candidates that it is of.
struct Carried {
  std::vector<int> active;
  Eigen::MatrixXd covariance;
};

Carried Carry(const Eigen::MatrixXd& T, const std::vector<int>& columns,
              const v1::Calibration& calibration, const Problem& problem) {
  const auto n = static_cast<Eigen::Index>(columns.size());
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::MatrixXd C = Eigen::Map<const RowMajor>(calibration.covariance().data(), n, n);
  const Eigen::MatrixXd of_columns = T(Eigen::all, columns);
  const Eigen::MatrixXd all = of_columns * C * of_columns.transpose();
  Carried carried;
  for (int i = 0; i < static_cast<int>(all.rows()); ++i) {
    if (std::sqrt(std::max(all(i, i), 0.0)) > kNoDeviation &&
        !IsUnseenRotation(i, problem, columns))
      carried.active.push_back(i);
  }
  const Eigen::MatrixXd active = all(carried.active, carried.active);
  carried.covariance = (active + active.transpose()) / 2;
  return carried;
}

absl::StatusOr<Carried> CarryOver(const Robot& robot, const v1::Calibration& calibration,
                                  const Stored& from, const Stored& to,
                                  const std::vector<int>& solved) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::vector<int> columns,
                            ColumnsOf(calibration, Candidates(from.problem)));
  if (columns.empty()) return Carried{{}, Eigen::MatrixXd(0, 0)};
  const Eigen::MatrixXd T =
      ConversionJacobian(robot, {from.problem, from.estimate}, {to.problem, to.estimate}, solved);
  return Carry(T, columns, calibration, to.problem);
}

// What the report says of the parameters, in the other model; sets, residuals and verdict are of
// the predictions, which stay.
void FillReport(const CalibrationResult& result, const std::optional<Pose>& X_FT_nominal,
                const v1::ModelDescription& description, v1::CalibrationReport* report) {
  const std::string from = report->model();
  const int rank = report->parameters().values_size();
  report->set_model(result.model.kind);
  report->set_convention(result.model.convention);
  *report->mutable_parameters() = ParametersOf(result, X_FT_nominal.value_or(Pose{}));
  report->clear_selection();
  report->clear_correlations();
  report->clear_change();
  report->clear_redundancies();
  for (const v1::Redundancy& redundancy : description.redundancies()) {
    const auto& values = report->parameters().values();
    const bool identified = std::any_of(values.begin(), values.end(), [&](const auto& value) {
      return value.name() == redundancy.dropped();
    });
    if (!identified) *report->add_redundancies() = redundancy;
  }
  report->add_warnings(absl::StrCat("converted from ", from, ": the readings were fitted there"));
  if (report->parameters().identified() > rank)
    report->add_warnings(absl::StrCat(
        "the covariance of ", report->parameters().identified(), " parameters has rank ", rank,
        ": directions that the readings did not determine stay as ", from, " held them"));
}

std::vector<v1::FrameEstimate> FramesAfter(const v1::CalibrationReport& report,
                                           const Estimate& estimate) {
  std::vector<v1::FrameEstimate> frames(report.frames().begin(), report.frames().end());
  size_t base = 0, tool = 0;
  for (v1::FrameEstimate& frame : frames)
    *frame.mutable_pose() =
        ToProto(frame.group() == v1::BASE ? estimate.X_MB[base++] : estimate.X_FT[tool++]);
  return frames;
}

// A result of its own, which no server has stored.
void ForgetOrigin(v1::Calibration* calibration) {
  calibration->clear_name();
  calibration->clear_job();
  calibration->clear_state();
  calibration->clear_release_steps();
  calibration->clear_created_by();
  calibration->clear_revision();
  calibration->clear_etag();
  calibration->clear_internal_parameters();
  calibration->clear_covariance();
}

absl::StatusOr<std::optional<Pose>> NamedTool(const v1::Nominal& nominal, const std::string& name) {
  if (name.empty()) return std::optional<Pose>();
  TRUEPOSE_ASSIGN_OR_RETURN(const Pose X_FT, ToolByName(nominal, name, "options.nominal_tool"));
  return std::optional<Pose>(X_FT);
}

}  // namespace

absl::StatusOr<v1::Calibration> RunConversion(const v1::Nominal& nominal,
                                              const v1::Calibration& calibration,
                                              const std::string& model) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Robot robot, RobotFrom(nominal));
  TRUEPOSE_ASSIGN_OR_RETURN(const CalibratedModel from, CalibratedModelFrom(robot, calibration));
  CalibrationResult result;
  TRUEPOSE_ASSIGN_OR_RETURN(result.model, ModelNamed(model, robot));
  AddEffectsOf(calibration.report(), robot, &result.model);
  const v1::CalibrationReport& report = calibration.report();
  const Stored all = StoredOf(report, from.model, from.lambda, /*identified=*/false);
  TRUEPOSE_ASSIGN_OR_RETURN(const Conversion conversion,
                            ConvertCalibration(robot, from.model, all.estimate, result.model));
  v1::Calibration converted = calibration;
  ForgetOrigin(&converted);
  converted.mutable_report()->clear_frames();
  for (v1::FrameEstimate& frame : FramesAfter(report, conversion.estimate))
    *converted.mutable_report()->add_frames() = std::move(frame);
  const Stored before = StoredOf(report, from.model, from.lambda, /*identified=*/true),
               after = StoredOf(converted.report(), result.model, conversion.estimate.lambda, true);
  TRUEPOSE_ASSIGN_OR_RETURN(Carried carried,
                            CarryOver(robot, calibration, before, after, conversion.solved));
  result.candidates = Candidates(after.problem);
  result.identification.estimate = after.estimate;
  result.identification.set.active = std::move(carried.active);
  result.identification.covariance = std::move(carried.covariance);
  TRUEPOSE_ASSIGN_OR_RETURN(const auto X_FT,
                            NamedTool(nominal, converted.options().nominal_tool()));
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::ModelDescription description,
                            RunModelDescription(nominal, model));
  FillReport(result, X_FT, description, converted.mutable_report());
  FillParameters(result, &converted);
  converted.mutable_options()->set_model(model);
  converted.set_digest(
      CalibrationDigest(result.model.convention, NominalDigest(nominal), converted));
  return converted;
}

}  // namespace truepose::convert
