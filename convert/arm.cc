#include "convert/arm.h"

#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "convert/robot.h"
#include "convert/torques.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/compensation/arm_from.h"

namespace truepose::convert {
namespace {

// What its own report says must not be applied does not reach a robot in a table either.
absl::Status CheckVerdict(const v1::CalibrationReport& report) {
  if (report.verdict() != "do_not_apply") return absl::OkStatus();
  const std::string reason = report.verdict_reasons().empty()
                                 ? ""
                                 : absl::StrCat(" (", *report.verdict_reasons().rbegin(), ")");
  FaultList faults;
  faults.Add("calibration.report.verdict", absl::StrCat("do_not_apply", reason),
             "a calibration that may be applied");
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

}  // namespace

absl::StatusOr<CalibratedArm> CalibratedArmFrom(const v1::Nominal& nominal,
                                                const v1::Calibration& calibration) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Robot robot, RobotFrom(nominal));
  TRUEPOSE_ASSIGN_OR_RETURN(CalibratedModel calibrated, CalibratedModelFrom(robot, calibration));
  TRUEPOSE_RETURN_IF_ERROR(CheckVerdict(calibration.report()));
  TRUEPOSE_RETURN_IF_ERROR(CheckTorquesOfTargets(calibrated));
  TRUEPOSE_ASSIGN_OR_RETURN(compensation::Arm arm,
                            ArmFrom(robot, calibrated.model, calibrated.lambda));
  arm.measuring = nominal.kind() == v1::MEASURING;
  return CalibratedArm{std::move(calibrated), arm};
}

}  // namespace truepose::convert
