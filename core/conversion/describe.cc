#include "core/conversion/describe.h"

#include <utility>

#include "absl/strings/numbers.h"
#include "core/base/status_macros.h"
#include "core/models/build_model.h"

namespace truepose {

absl::StatusOr<ModelDescription> DescribeModel(const std::string& kind, const Robot& robot) {
  ModelDescription description;
  TRUEPOSE_ASSIGN_OR_RETURN(description.model, BuildModel(kind, robot, ModelExtent::kInternal));
  Problem problem{&description.model, {Reading{}}, {""}, {""}};
  problem.readings[0].kind = ObservationKind::kPose;
  description.candidates = Candidates(problem);
  description.generic = GenericIdentifiable(problem, robot);
  description.counts = CountParameters(robot, problem, description.generic);
  return description;
}

std::optional<int> LinkOf(const std::string& name) {
  const size_t last = name.find_last_not_of("0123456789");
  int link = 0;
  if (!absl::SimpleAtoi(name.substr(last == std::string::npos ? 0 : last + 1), &link))
    return std::nullopt;
  return link;
}

}  // namespace truepose
