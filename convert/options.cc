#include "convert/options.h"

#include <string>
#include <utility>
#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "convert/report.h"
#include "core/base/fault.h"
#include "core/models/build_model.h"

namespace truepose::convert {
namespace {

template <typename T>
using Names = std::vector<std::pair<std::string, T>>;

// The value that a name stands for; an unknown name is a fault that lists them all. "" is the
// first.
template <typename T>
T Named(const std::string& name, const Names<T>& names, const std::string& field,
        FaultList* faults) {
  if (name.empty()) return names[0].second;
  std::vector<std::string> known;
  for (const auto& [text, value] : names) {
    if (text == name) return value;
    known.push_back(text);
  }
  faults->Add(field, absl::StrCat("'", name, "'"), absl::StrJoin(known, ", "));
  return names[0].second;
}

const Names<Estimator>& Estimators() {
  static const Names<Estimator> names = {{"levenberg_marquardt", Estimator::kLevenbergMarquardt},
                                         {"linear_iteration", Estimator::kLinearIteration},
                                         {"kalman", Estimator::kKalman},
                                         {"simplex", Estimator::kSimplex}};
  return names;
}

const Names<SimplexObjective>& Objectives() {
  static const Names<SimplexObjective> names = {{"least_squares", SimplexObjective::kLeastSquares},
                                                {"e_op", SimplexObjective::kMeanPositionError}};
  return names;
}

const Names<Loss>& Losses() {
  static const Names<Loss> names = {
      {"none", Loss::kNone}, {"huber", Loss::kHuber}, {"tukey", Loss::kTukey}};
  return names;
}

const Names<PriorKind>& Priors() {
  static const Names<PriorKind> names = {{"none", PriorKind::kNone},
                                         {"tolerance", PriorKind::kTolerance},
                                         {"calibration", PriorKind::kStored}};
  return names;
}

using Criterion = std::optional<SelectionCriterion>;

const Names<Criterion>& Criteria() {
  static const Names<Criterion> names = {
      {"none", std::nullopt},
      {"forward", SelectionCriterion::kForward},
      {"bic", SelectionCriterion::kBic},
      {"cross_validation", SelectionCriterion::kCrossValidation}};
  return names;
}

Names<EffectGroup> Effects() {
  Names<EffectGroup> names;
  for (EffectGroup group : AllEffectGroups()) names.emplace_back(Name(group), group);
  return names;
}

void ReadModel(const std::string& name, CalibrateOptions* options, FaultList* faults) {
  if (name.empty()) return;
  Names<std::string> names;
  for (const std::string& kind : ModelKinds()) names.emplace_back(kind, kind);
  options->model = Named(name, names, "options.model", faults);
}

// The other estimators have one objective, least squares, so even naming it is a mistake about what
// the option does.
void ReadSolver(const v1::CalibrationOptions& message, SolveOptions* solve, FaultList* faults) {
  solve->estimator = Named(message.estimator(), Estimators(), "options.estimator", faults);
  solve->simplex.objective = Named(message.objective(), Objectives(), "options.objective", faults);
  if (message.objective().empty() || message.estimator() == "simplex") return;
  faults->Add("options.objective",
              absl::StrCat("'", message.objective(), "' with estimator ", Name(solve->estimator)),
              "estimator simplex: the others know least squares alone");
}

void ReadSelect(const std::string& name, CalibrateOptions* options, FaultList* faults) {
  const Criterion criterion = Named(name, Criteria(), "options.select", faults);
  if (!criterion) return;
  options->select = SelectionOptions{};
  options->select->criterion = *criterion;
}

void ReadEffects(const std::string& text, CalibrateOptions* options, FaultList* faults) {
  if (text.empty() || text == "none") return;
  if (text == "auto") {
    options->effects = EffectsMode::kAuto;
    return;
  }
  options->effects = EffectsMode::kListed;
  for (absl::string_view word : absl::StrSplit(text, ',', absl::SkipWhitespace())) {
    const std::string name(absl::StripAsciiWhitespace(word));
    FaultList unknown;
    const EffectGroup group = Named(name, Effects(), "options.effects", &unknown);
    faults->AddAll(unknown.ToStatus());
    auto& groups = options->effect_groups;
    if (std::find(groups.begin(), groups.end(), group) == groups.end()) groups.push_back(group);
  }
  if (options->effect_groups.empty())
    faults->Add("options.effects", absl::StrCat("'", text, "', an empty list"),
                "none, auto or a list of effects");
}

Eigen::MatrixXd SquareOf(const google::protobuf::RepeatedField<double>& values, int size) {
  Eigen::MatrixXd m(size, size);
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) m(i, j) = values[i * size + j];
  }
  return m;
}

void ReadStored(const v1::PriorCalibration& message, CalibrateOptions* options, FaultList* faults) {
  StoredCalibration stored;
  stored.convention = message.convention();
  for (const v1::InternalParameter& parameter : message.internal_parameters())
    stored.internal.emplace_back(parameter.name(), parameter.value());
  stored.identified.assign(message.identified().begin(), message.identified().end());
  const int n = message.identified_size();
  if (message.covariance_size() != n * n) {
    faults->Add("options.prior_calibration.covariance",
                absl::StrCat(message.covariance_size(), " values"),
                absl::StrCat(n, " x ", n, ", a row for each identified parameter"));
    return;
  }
  stored.covariance = SquareOf(message.covariance(), n);
  stored.model_error = {message.model_sd_position_mm() / kMmPerM,
                        message.model_sd_rotation_deg() / kDegPerRad};
  if (!(stored.model_error.position_sd_m > 0))
    faults->Add("options.prior_calibration.model_sd_position_mm",
                absl::StrCat(message.model_sd_position_mm()), "more than 0");
  if (!(stored.model_error.rotation_sd_rad > 0))
    stored.model_error.rotation_sd_rad = ModelError{}.rotation_sd_rad;
  options->stored = std::move(stored);
}

void ReadPrior(const v1::CalibrationOptions& message, CalibrateOptions* options,
               FaultList* faults) {
  options->prior = Named(message.prior(), Priors(), "options.prior", faults);
  const bool stored = options->prior == PriorKind::kStored;
  if (stored && !message.has_prior_calibration())
    faults->Add("options.prior_calibration", "none", "the calibration that prior = calibration is");
  if (!stored && message.has_prior_calibration())
    faults->Add("options.prior", absl::StrCat("'", message.prior(), "' beside a prior calibration"),
                "calibration");
  if (message.has_prior_calibration()) ReadStored(message.prior_calibration(), options, faults);
}

// Eqs. 8 and 9 in joint space: R = J_q S_q J_q' alone, so that |W r| is the joints' residual in
// their own standard deviations; what the model can't explain scales the covariance instead.
void ReadPoseMatching(const v1::CalibrationOptions& message, CalibrateOptions* options,
                      FaultList* faults) {
  const Names<bool> names = {{"task_space", false}, {"joint_space", true}};
  if (!Named(message.pose_matching(), names, "options.pose_matching", faults)) return;
  if (message.joint_sd_size() == 0)
    faults->Add("options.joint_sd", "none", "the joints' noise, which joint_space weighs by");
  options->identify.known_model_error = ModelError{0, 0};
  options->identify.scale_covariance = true;
}

}  // namespace

absl::StatusOr<CalibrateOptions> CalibrateOptionsFrom(const v1::CalibrationOptions& message) {
  CalibrateOptions options;
  FaultList faults;
  options.require_complete = message.require_complete();
  ReadModel(message.model(), &options, &faults);
  ReadSolver(message, &options.identify.solve, &faults);
  options.identify.loss = Named(message.loss(), Losses(), "options.loss", &faults);
  ReadSelect(message.select(), &options, &faults);
  ReadEffects(message.effects(), &options, &faults);
  ReadPrior(message, &options, &faults);
  ReadPoseMatching(message, &options, &faults);
  options.calibrate = message.calibrate();
  if (!faults.empty()) return faults.ToStatus();
  return options;
}

}  // namespace truepose::convert
