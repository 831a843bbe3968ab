#include "core/calibrate/checks.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"

namespace truepose {

absl::Status CheckProblem(const CalibrationProblem& problem) {
  FaultList faults;
  if (problem.readings.empty()) faults.Add("readings", "none that can be used", "at least one");
  if (problem.calibrates.size() != problem.readings.size()) {
    faults.Add("roles", absl::StrCat(problem.calibrates.size()),
               absl::StrCat(problem.readings.size(), ", one a reading"));
  } else if (std::count(problem.calibrates.begin(), problem.calibrates.end(), true) == 0) {
    faults.Add("readings", "no calibration row that can be used", "at least one");
  }
  return faults.ToStatus();
}

absl::Status CheckRedundancy(const Identification& identification) {
  const int unknowns = static_cast<int>(identification.set.active.size());
  if (identification.rows > unknowns) return absl::OkStatus();
  FaultList faults;
  faults.Add("readings",
             absl::StrCat(identification.rows, " measured values for ", unknowns, " parameters"),
             "more measured values than parameters: the weights come from what is left over");
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

absl::Status CheckComplete(const IdentifiableSet& set, const ParameterSet& candidates) {
  FaultList faults;
  for (const NullRelation& relation : set.redundancies) {
    if (relation.structural) continue;
    faults.Add(candidates[relation.dropped].name, ReasonText(relation, candidates),
               "readings that determine every parameter (require_complete)");
  }
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

}  // namespace truepose
