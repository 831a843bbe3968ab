#include "convert/calibrated_model.h"

#include "absl/strings/str_cat.h"
#include "convert/frames.h"
#include "core/base/fault.h"

namespace truepose::convert {

absl::StatusOr<CalibratedModel> CalibratedModelFrom(const Robot& robot,
                                                    const v1::Calibration& calibration) {
  CalibratedModel result{ModifiedIncremental(robot, ModelExtent::kInternal), {}};
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
