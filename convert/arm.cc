#include "convert/arm.h"

#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "convert/robot.h"
#include "convert/torques.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/compensation/arm_from.h"

namespace truepose::convert {
absl::Status CheckMayBeApplied(const v1::CalibrationReport& report) {
  if (report.verdict() != "do_not_apply") return absl::OkStatus();
  const std::string reasons = absl::StrJoin(report.verdict_reasons(), "; ");
  FaultList faults;
  faults.Add("calibration.report.verdict",
             absl::StrCat("do_not_apply", reasons.empty() ? "" : absl::StrCat(" (", reasons, ")")),
             "a calibration that may be applied");
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

absl::StatusOr<CalibratedArm> CalibratedArmFrom(const v1::Nominal& nominal,
                                                const v1::Calibration& calibration) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Robot robot, RobotFrom(nominal));
  TRUEPOSE_ASSIGN_OR_RETURN(CalibratedModel calibrated, CalibratedModelFrom(robot, calibration));
  TRUEPOSE_RETURN_IF_ERROR(CheckMayBeApplied(calibration.report()));
  TRUEPOSE_RETURN_IF_ERROR(CheckTorquesOfTargets(calibrated));
  TRUEPOSE_ASSIGN_OR_RETURN(compensation::Arm arm,
                            ArmFrom(robot, calibrated.model, calibrated.lambda));
  arm.measuring = nominal.kind() == v1::MEASURING;
  return CalibratedArm{std::move(calibrated), arm};
}

}  // namespace truepose::convert
