#include "convert/calibrated_model.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "convert/frames.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/models/build_model.h"

namespace truepose::convert {

namespace {

// The kind of model and the effects that a report names.
absl::StatusOr<Model> ModelOf(const Robot& robot, const v1::CalibrationReport& report) {
  const std::string kind = report.model().empty() ? "modified_incremental" : report.model();
  auto built = BuildModel(kind, robot, ModelExtent::kInternal);
  if (!built.ok())
    return FaultStatus("calibration.report.model", absl::StrCat("'", report.model(), "'"),
                       "a model of this program");
  for (const std::string& name : report.effects()) {
    const auto group = std::find_if(AllEffectGroups().begin(), AllEffectGroups().end(),
                                    [&](EffectGroup known) { return Name(known) == name; });
    if (group == AllEffectGroups().end())
      return FaultStatus("calibration.report.effects", absl::StrCat("'", name, "'"),
                         "an effect of this program");
    AddEffects(robot, *group, &*built);
  }
  return built;
}

}  // namespace

absl::StatusOr<CalibratedModel> CalibratedModelFrom(const Robot& robot,
                                                    const v1::Calibration& calibration) {
  CalibratedModel result;
  TRUEPOSE_ASSIGN_OR_RETURN(result.model, ModelOf(robot, calibration.report()));
  const int count = result.model.parameters.size();
  result.lambda = Eigen::VectorXd::Zero(count);
  FaultList faults;
  if (calibration.report().convention() != result.model.convention) {
    faults.Add("calibration.report.convention",
               absl::StrCat("'", calibration.report().convention(), "'"), result.model.convention);
  }
  if (calibration.internal_parameters_size() != count) {
    faults.Add("calibration.internal_parameters",
               absl::StrCat(calibration.internal_parameters_size(), " parameters"),
               absl::StrCat(count, ", those of this robot"));
  }
  for (int i = 0; i < calibration.internal_parameters_size(); ++i) {
    const v1::InternalParameter& parameter = calibration.internal_parameters(i);
    const std::string field = absl::StrCat("calibration.internal_parameters[", i, "]");
    CheckFinite(parameter.value(), field + ".value", &faults);
    if (const auto index = result.model.parameters.Find(parameter.name())) {
      result.lambda(*index) = parameter.value();
    } else {
      faults.Add(field + ".name", absl::StrCat("'", parameter.name(), "'"),
                 "a parameter of this robot's model");
    }
  }
  if (!faults.empty()) return faults.ToStatus();
  return result;
}

}  // namespace truepose::convert
