#include "core/calibrate/parameter_choice.h"

namespace truepose {
namespace {

bool IsInBaseSet(const Parameter& parameter) {
  return parameter.role == ParameterRole::kExternal ||
         parameter.role == ParameterRole::kJointOffset || parameter.role == ParameterRole::kLength;
}

}  // namespace

absl::StatusOr<SelectionResult> ChooseParameters(const Problem& problem, const Identification& full,
                                                 const Estimate& start,
                                                 const SelectionOptions& options,
                                                 const Hooks& hooks) {
  const ParameterSet names = Candidates(problem);
  std::vector<int> base;
  std::vector<SelectionCandidate> candidates;
  for (int candidate : full.set.active) {
    if (IsInBaseSet(names[candidate])) {
      base.push_back(candidate);
    } else {
      candidates.push_back({names[candidate].name, {candidate}});
    }
  }
  SelectionOptions by_row = options;
  by_row.units = UnitsOf(problem).of;
  return Select(problem, full.model_error, start, base, candidates, by_row, hooks);
}

}  // namespace truepose
