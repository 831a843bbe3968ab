// Models by name.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/models/model.h"

namespace truepose {

// "modified_incremental", "incremental", "zhuang_roth", "extended_dh".
const std::vector<std::string>& ModelKinds();

// The model of that kind, all candidates; see model.h for the four.
// @returns kInvalidArgument with the fault `options.model` for an unknown kind, and for a model
// without any parameter: the incremental ones have none between base and flange of a robot with one
// joint.
absl::StatusOr<Model> BuildModel(const std::string& kind, const Robot& robot, ModelExtent extent);

}  // namespace truepose
