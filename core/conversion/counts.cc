#include "core/conversion/counts.h"

#include <algorithm>

namespace truepose {

ParameterCounts CountParameters(const Robot& robot, const Problem& problem,
                                const IdentifiableSet& generic) {
  int axes = 0, measured = 0;
  for (const Joint& joint : robot.joints()) axes += joint.type == JointType::kRevolute ? 4 : 2;
  for (const Reading& reading : problem.readings) measured = std::max(measured, RowsOf(reading));
  ParameterCounts counts{axes + 6, axes + measured, axes - 6};
  const ParameterSet candidates = Candidates(problem);
  for (int index : generic.active) {
    if (candidates[index].role == ParameterRole::kEffect) continue;
    ++counts.rank;
    // External candidates are preferred, so those that are kept are a basis of their own span.
    if (index < problem.FirstInternal()) ++counts.external_rank;
  }
  return counts;
}

}  // namespace truepose
