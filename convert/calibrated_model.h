// A stored calibration back in the core: the model and its internal parameters.
#pragma once

#include "absl/status/statusor.h"
#include "convert/run.h"
#include "core/models/model.h"

namespace truepose::convert {

struct CalibratedModel {
  Model model;
  Eigen::VectorXd lambda;
};

// @returns kInvalidArgument with faults `calibration.internal_parameters[i]` for a convention, a
// name or a count that
//   this robot's model does not have: the calibration is of another robot or model.
absl::StatusOr<CalibratedModel> CalibratedModelFrom(const Robot& robot,
                                                    const v1::Calibration& calibration);

}  // namespace truepose::convert
