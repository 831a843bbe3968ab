#include "convert/torques.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"

namespace truepose::convert {
namespace {

// A simulated truth or a prior may carry the parameters at zero: those need nothing.
bool HasCompliance(const CalibratedModel& calibrated) {
  return std::any_of(calibrated.model.effects.begin(), calibrated.model.effects.end(),
                     [&](const JointEffect& effect) {
                       return effect.kind == EffectKind::kTorque &&
                              calibrated.lambda(effect.parameter) != 0;
                     });
}

}  // namespace

bool NeedsMeasuredTorques(const Model& model) {
  return model.masses.empty() &&
         std::any_of(model.effects.begin(), model.effects.end(),
                     [](const JointEffect& effect) { return effect.kind == EffectKind::kTorque; });
}

absl::Status CheckTorquesOfTargets(const CalibratedModel& calibrated) {
  if (!NeedsMeasuredTorques(calibrated.model) || !HasCompliance(calibrated))
    return absl::OkStatus();
  return FaultStatus("calibration.report.effects",
                     "compliance from measured torques, which targets don't have",
                     "masses in the robot file and a calibration made with it, so that torques of "
                     "gravity are known everywhere; or a calibration without compliance");
}

absl::Status CheckTorquesOfReadings(const CalibratedModel& calibrated,
                                    const std::vector<Reading>& readings) {
  if (!NeedsMeasuredTorques(calibrated.model) || !HasCompliance(calibrated))
    return absl::OkStatus();
  const auto lacks = [](const Reading& r) { return r.conditions.joint_torque.size() == 0; };
  const auto missing = std::count_if(readings.begin(), readings.end(), lacks);
  if (missing == 0) return absl::OkStatus();
  return FaultStatus("readings",
                     absl::StrCat("no joint torques in ", missing, " of ", readings.size(),
                                  " readings, and the calibration has compliance"),
                     "joint torques in every reading (tau1_Nm...), or a calibration made with "
                     "masses in the robot file");
}

std::string TorqueWarning(const Model& model) {
  if (!NeedsMeasuredTorques(model)) return "";
  return "compliance was identified from measured torques: it can be compensated only where "
         "torques "
         "are known; with masses in the robot file `compensate` reckons them from gravity";
}

}  // namespace truepose::convert
