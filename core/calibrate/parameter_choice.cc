#include "core/calibrate/parameter_choice.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose {
namespace {

bool IsInBaseSet(const Parameter& parameter) {
  return parameter.role == ParameterRole::kExternal ||
         parameter.role == ParameterRole::kJointOffset || parameter.role == ParameterRole::kLength;
}

constexpr int kLeastFolds = 2;

absl::Status CheckRows(const Units& units, const SelectionOptions& options) {
  if (units.count >= kLeastFolds) return absl::OkStatus();
  return FaultStatus(
      "options.select",
      absl::StrCat(Name(options.criterion), " with ", units.count, " calibration rows"),
      absl::StrCat("at least ", kLeastFolds,
                   " rows: each fold is predicted by the others (none, forward and "
                   "bic do without folds)"));
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
  const Units units = UnitsOf(problem);
  by_row.units = units.of;
  by_row.folds = std::min(options.folds, units.count);
  if (options.criterion == SelectionCriterion::kCrossValidation)
    TRUEPOSE_RETURN_IF_ERROR(CheckRows(units, options));
  return Select(problem, full.model_error, start, base, candidates, by_row, hooks);
}

}  // namespace truepose
