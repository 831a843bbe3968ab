#include "core/calibrate/checks.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "core/base/fault.h"

namespace truepose {
namespace {

// "joints j1, j2".
std::string NoisyJoints(const Robot& robot, const Reading& reading) {
  std::vector<std::string> names;
  for (int i = 0; i < std::min<int>(robot.joint_count(), reading.joint_sd.size()); ++i)
    if (reading.joint_sd(i) > 0) names.push_back(robot.joints()[i].name);
  return names.empty() ? "no joint" : absl::StrCat("joints ", absl::StrJoin(names, ", "));
}

// The rows of a residual, in words.
std::string CoordinatesOf(const Reading& reading) {
  const int positions = PositionRowsOf(reading);
  return absl::StrCat(positions, " of position, ", RowsOf(reading) - positions, " of rotation");
}

}  // namespace

absl::Status CheckProblem(const CalibrationProblem& problem) {
  FaultList faults;
  if (problem.readings.empty()) {
    faults.Add("readings", "none that can be used", "at least one");
  } else if (problem.calibrates.size() != problem.readings.size()) {
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

absl::Status CheckEffects(const Robot& robot, const Problem& part,
                          const std::vector<EffectGroup>& groups) {
  const std::vector<EffectGroup> available = AvailableEffects(robot, part);
  FaultList faults;
  for (EffectGroup group : groups) {
    if (std::find(available.begin(), available.end(), group) != available.end()) continue;
    const bool compliance = group == EffectGroup::kCompliance;
    faults.Add("options.effects", absl::StrCat("'", Name(group), "' without its cause"),
               compliance
                   ? "joint torques in every reading (tau1_Nm...), or masses in the robot file"
                   : "a temperature (temp_C) that varies");
  }
  return faults.ToStatus();
}

absl::Status CheckJointSpace(const Robot& robot, const Problem& part, const Estimate& start,
                             const IdentifyOptions& options) {
  const std::optional<ModelError>& known = options.known_model_error;
  if (!known || known->position_sd_m > 0 || known->rotation_sd_rad > 0) return absl::OkStatus();
  const auto exact = [&](const Reading& reading) {
    return StatedRank(part, reading, start) < RowsOf(reading);
  };
  const auto first = std::find_if(part.readings.begin(), part.readings.end(), exact);
  if (first == part.readings.end()) return absl::OkStatus();
  FaultList faults;
  faults.Add(
      "options.pose_matching",
      absl::StrCat("joint_space, where the noise of ", NoisyJoints(robot, *first), " reaches ",
                   StatedRank(part, *first, start), " of the ", RowsOf(*first),
                   " measured coordinates (", CoordinatesOf(*first), ") of reading ", first->id + 1,
                   "; so in ", std::count_if(first, part.readings.end(), exact), " of ",
                   part.readings.size(), " readings"),
      "noise that reaches every measured coordinate; task_space, which adds what stays "
      "unexplained, takes these readings");
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

absl::Status CheckConvention(const StoredCalibration& stored, const Model& model) {
  if (stored.convention.empty() || stored.convention == model.convention) return absl::OkStatus();
  return FaultStatus("options.model", absl::StrCat("'", model.kind, "'"),
                     absl::StrCat("the model of the prior calibration (", stored.convention, ")"));
}

absl::Status CheckNamed(const Scope& scope, const IdentifiableSet& set,
                        const ParameterSet& candidates) {
  FaultList faults;
  for (const NullRelation& relation : set.redundancies) {
    if (std::find(scope.named.begin(), scope.named.end(), relation.dropped) == scope.named.end())
      continue;
    faults.Add("options.calibrate", ReasonText(relation, candidates),
               "parameters that these readings can tell; what base or tool takes up is found with "
               "calibrate = external");
  }
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

}  // namespace truepose
