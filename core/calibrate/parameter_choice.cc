#include "core/calibrate/parameter_choice.h"

#include <map>

namespace truepose {
namespace {

bool IsInBaseSet(const Parameter& parameter) {
  return parameter.role == ParameterRole::kExternal ||
         parameter.role == ParameterRole::kJointOffset || parameter.role == ParameterRole::kLength;
}

// Readings of one row share its joints: they are never separated.
std::vector<int> UnitsOf(const Problem& problem) {
  std::map<int, int> unit_of_id;
  std::vector<int> units;
  for (const Reading& reading : problem.readings)
    units.push_back(
        unit_of_id.emplace(reading.id, static_cast<int>(unit_of_id.size())).first->second);
  return units;
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
  by_row.units = UnitsOf(problem);
  return Select(problem, full.model_error, start, base, candidates, by_row, hooks);
}

}  // namespace truepose
