#include "core/compensation/compensate.h"

#include <optional>

#include "absl/strings/str_cat.h"
#include "convert/calibrated_model.h"
#include "convert/frames.h"
#include "convert/report.h"
#include "convert/robot.h"
#include "convert/run.h"
#include "convert/torques.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::convert {
namespace {

absl::Status CheckTargets(const v1::CompensateRequest& request, int joints) {
  FaultList faults;
  for (int i = 0; i < request.targets_size(); ++i) {
    const v1::CompensationTarget& target = request.targets(i);
    const std::string field = absl::StrCat("targets[", i, "]");
    if (!target.has_pose() && target.joints_size() == 0)
      faults.Add(field, "neither joints nor pose", "one of them");
    if (target.joints_size() != 0 && target.joints_size() != joints) {
      faults.Add(field + ".joints", absl::StrCat(target.joints_size(), " values"),
                 absl::StrCat(joints));
    }
    for (int j = 0; j < target.joints_size(); ++j)
      CheckSize(target.joints(j), kLargestJoint, absl::StrCat(field, ".joints[", j, "]"), &faults);
    if (target.has_pose()) CheckPose(target.pose(), field + ".pose", &faults);
  }
  return faults.ToStatus();
}

// Compensates targets of one robot with one tool.
class Compensator {
 public:
  Compensator(const Robot& robot, const CalibratedModel& calibrated, const Pose& X_FT,
              v1::RobotKind kind)
      : robot_(robot),
        kind_(kind),
        model_(calibrated.model),
        lambda_(calibrated.lambda),
        nominal_(Eigen::VectorXd::Zero(calibrated.lambda.size())),
        X_FT_(X_FT) {}

  v1::CompensatedTarget Run(const v1::CompensationTarget& target) const {
    v1::CompensatedTarget result;
    const absl::Status status = Correct(target, &result);
    if (!status.ok()) {
      result.Clear();
      result.set_fault(std::string(status.message()));
    }
    result.set_row(target.row());
    return result;
  }

 private:
  absl::Status Correct(const v1::CompensationTarget& target, v1::CompensatedTarget* result) const {
    if (kind_ == v1::MEASURING) return RunTip(target, result);
    return target.has_pose() ? RunPose(target, result) : RunJoints(target, result);
  }

  // A measuring robot is read, not commanded: joints in, the tip where it really is out.
  absl::Status RunTip(const v1::CompensationTarget& target, v1::CompensatedTarget* result) const {
    if (target.has_pose()) {
      return absl::FailedPreconditionError(
          "a measuring robot can't be sent to a pose: give the joints that were read");
    }
    const Eigen::VectorXd q = robot_.joint_map().ToChain(JointsOf(target));
    const Pose X_BT = Forward(model_, q, lambda_) * X_FT_;
    *result->mutable_pose() = ToProto(X_BT);
    SetCorrection(X_BT, Forward(model_, q, nominal_) * X_FT_, result);
    return absl::OkStatus();
  }

  absl::Status RunJoints(const v1::CompensationTarget& target,
                         v1::CompensatedTarget* result) const {
    const Eigen::VectorXd q = robot_.joint_map().ToChain(JointsOf(target));
    TRUEPOSE_RETURN_IF_ERROR(CheckLimits(JointsOf(target), "target"));
    return Solve(q, Forward(model_, q, nominal_), result);
  }

  absl::Status RunPose(const v1::CompensationTarget& target, v1::CompensatedTarget* result) const {
    const Pose X_BF = PoseFrom(target.pose()) * Inverse(X_FT_);
    const Eigen::VectorXd preferred =
        target.joints_size() > 0 ? JointsOf(target) : robot_.MiddleOfLimits();
    TRUEPOSE_ASSIGN_OR_RETURN(const Eigen::VectorXd q,
                              NominalInverse(robot_, model_, X_BF, preferred, {}));
    return Solve(q, X_BF, result);
  }

  // @param q chain joints at which the nominal flange is at X_BF.
  absl::Status Solve(const Eigen::VectorXd& q, const Pose& X_BF,
                     v1::CompensatedTarget* result) const {
    TRUEPOSE_ASSIGN_OR_RETURN(const Compensated solved, SolvePose(model_, lambda_, X_BF, q, {}));
    const Eigen::VectorXd q_controller = robot_.joint_map().ToController(solved.q);
    TRUEPOSE_RETURN_IF_ERROR(CheckLimits(q_controller, "compensated"));
    for (double value : q_controller) result->add_joints(value);
    *result->mutable_pose() = ToProto(Forward(model_, solved.q, nominal_) * X_FT_);
    SetCorrection(X_BF * X_FT_, Forward(model_, q, lambda_) * X_FT_, result);
    result->set_residual_position_mm(solved.position_residual_m * kMmPerM);
    result->set_iterations(solved.iterations);
    return absl::OkStatus();
  }

  static void SetCorrection(const Pose& desired, const Pose& uncompensated,
                            v1::CompensatedTarget* result) {
    result->set_position_correction_mm((desired.p - uncompensated.p).norm() * kMmPerM);
    result->set_rotation_correction_deg(
        LogRotation<double>(desired.R * uncompensated.R.transpose()).norm() * kDegPerRad);
  }

  absl::Status CheckLimits(const Eigen::VectorXd& q, const std::string& what) const {
    for (int i = 0; i < robot_.joint_count(); ++i) {
      const Joint& joint = robot_.joints()[i];
      if (q(i) >= joint.lower && q(i) <= joint.upper) continue;
      const bool angle = joint.type == JointType::kRevolute;
      const double scale = angle ? kDegPerRad : kMmPerM;
      return absl::FailedPreconditionError(
          absl::StrCat(what, " joint ", joint.name, " at ", q(i) * scale, " is beyond its limits ",
                       joint.lower * scale, " to ", joint.upper * scale, angle ? " deg" : " mm"));
    }
    return absl::OkStatus();
  }

  static Eigen::VectorXd JointsOf(const v1::CompensationTarget& target) {
    return Eigen::Map<const Eigen::VectorXd>(target.joints().data(), target.joints_size());
  }

  const Robot& robot_;
  const v1::RobotKind kind_;
  const Model& model_;
  const Eigen::VectorXd& lambda_;
  const Eigen::VectorXd nominal_;
  const Pose X_FT_;
};

// What its own report says must not be applied does not reach a robot by this way either.
absl::Status CheckVerdict(const v1::Calibration& calibration) {
  const v1::CalibrationReport& report = calibration.report();
  if (report.verdict() != "do_not_apply") return absl::OkStatus();
  const std::string reason = report.verdict_reasons().empty()
                                 ? ""
                                 : absl::StrCat(" (", *report.verdict_reasons().rbegin(), ")");
  FaultList faults;
  faults.Add("calibration.report.verdict", absl::StrCat("do_not_apply", reason),
             "a calibration that may be applied");
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

absl::StatusOr<Pose> ToolOf(const v1::Nominal& nominal, const std::string& name) {
  if (name.empty()) return Pose{};
  return ToolByName(nominal, name, "tool");
}

}  // namespace

absl::StatusOr<v1::CompensateResponse> RunCompensation(const v1::Nominal& nominal,
                                                       const v1::Calibration& calibration,
                                                       const v1::CompensateRequest& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Robot robot, RobotFrom(nominal));
  TRUEPOSE_ASSIGN_OR_RETURN(const CalibratedModel calibrated,
                            CalibratedModelFrom(robot, calibration));
  TRUEPOSE_RETURN_IF_ERROR(CheckVerdict(calibration));
  TRUEPOSE_RETURN_IF_ERROR(CheckTorquesOfTargets(calibrated));
  TRUEPOSE_RETURN_IF_ERROR(CheckTargets(request, robot.joint_count()));
  TRUEPOSE_ASSIGN_OR_RETURN(const Pose X_FT, ToolOf(nominal, request.tool()));
  const Compensator compensator(robot, calibrated, X_FT, nominal.kind());
  v1::CompensateResponse response;
  for (const v1::CompensationTarget& target : request.targets())
    *response.add_targets() = compensator.Run(target);
  return response;
}

}  // namespace truepose::convert
