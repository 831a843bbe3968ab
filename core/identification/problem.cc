#include "core/identification/problem.h"

#include <numeric>

namespace truepose {
namespace {

void AddFrames(ParameterGroup group, const std::vector<std::string>& labels, ParameterSet* set) {
  for (const std::string& label : labels) {
    for (int i = 0; i < kFrameParameters; ++i) {
      set->Add(FrameParameter(group, labels.size() > 1 ? label : std::string(), i));
    }
  }
}

}  // namespace

ParameterSet Candidates(const Problem& problem) {
  ParameterSet set;
  AddFrames(ParameterGroup::kBase, problem.placements, &set);
  AddFrames(ParameterGroup::kTool, problem.targets, &set);
  for (const Parameter& parameter : problem.model->parameters) set.Add(parameter);
  return set;
}

Estimate NominalEstimate(const Problem& problem) {
  return {std::vector<Pose>(problem.placements.size()), std::vector<Pose>(problem.targets.size()),
          Eigen::VectorXd::Zero(problem.model->parameters.size())};
}

std::vector<int> ExternalCandidates(const Problem& problem) {
  std::vector<int> external(problem.FirstInternal());
  std::iota(external.begin(), external.end(), 0);
  return external;
}

}  // namespace truepose
