#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "compensation/inverse.h"
#include "convert/arm.h"
#include "convert/frames.h"
#include "convert/report.h"
#include "convert/robot.h"
#include "convert/run.h"
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

constexpr double kNothingLeft = 1e-9;  // m, rad: below any robot's resolution

using compensation::Correction;
using compensation::ExactOptions;
using compensation::Outcome;

// Why a target was not compensated; OK = it was.
struct Refused {
  v1::CompensationOutcome outcome = v1::COMPENSATION_OK;
  std::string why = {};
  int joint = -1;
};

void FillRefused(const Refused& refused, v1::CompensatedTarget* result) {
  result->Clear();
  result->set_fault(refused.why);
  if (refused.joint >= 0) result->set_joint(refused.joint);
}

// Compensates targets of one robot with one tool, one after the other.
class Compensator {
 public:
  Compensator(const Robot& robot, const compensation::Arm& arm, const Pose& X_FT)
      : robot_(robot), arm_(arm), X_FT_(X_FT), before_(robot.MiddleOfLimits()) {
    // Far below any encoder, so that equal targets get equal joints whatever way they came.
    options_.position_tolerance_m = options_.rotation_tolerance_rad = 1e-13;
    options_.point_F = X_FT.p;
  }

  v1::CompensatedTarget Run(const v1::CompensationTarget& target) {
    v1::CompensatedTarget result;
    const Refused refused = Correct(target, &result);
    if (refused.outcome != v1::COMPENSATION_OK) FillRefused(refused, &result);
    result.set_outcome(refused.outcome);
    result.set_row(target.row());
    return result;
  }

 private:
  Refused Correct(const v1::CompensationTarget& target, v1::CompensatedTarget* result) {
    if (arm_.measuring) return RunTip(target, result);
    return target.has_pose() ? RunPose(target, result) : RunJoints(target, result);
  }

  // A measuring robot is read, not commanded: joints in, the tip where it really is out.
  Refused RunTip(const v1::CompensationTarget& target, v1::CompensatedTarget* result) const {
    if (target.has_pose()) {
      return {v1::COMPENSATION_INVALID_TARGET,
              "a measuring robot can't be sent to a pose: give the joints that were read"};
    }
    const double* q = target.joints().data();
    const Pose X_BT = CorrectedTip(arm_, q, X_FT_, Eigen::Vector3d::UnitZ()).X_BT;
    *result->mutable_pose() = ToProto(X_BT);
    SetCorrection(X_BT, NominalFlange(arm_, q) * X_FT_, result);
    return {};
  }

  Refused RunJoints(const v1::CompensationTarget& target, v1::CompensatedTarget* result) {
    const double* q = target.joints().data();
    Refused beyond = CheckLimits(q);
    if (beyond.outcome != v1::COMPENSATION_OK) return beyond;
    return Fill(q, NominalFlange(arm_, q), CorrectJoints(arm_, q, options_), result);
  }

  // A row of poses is a path: without joints of its own each keeps the configuration before.
  Refused RunPose(const v1::CompensationTarget& target, v1::CompensatedTarget* result) {
    const Pose X_BF = PoseFrom(target.pose()) * Inverse(X_FT_);
    const Eigen::VectorXd seed =
        target.joints_size() > 0
            ? Eigen::Map<const Eigen::VectorXd>(target.joints().data(), target.joints_size())
            : before_;
    const Correction nominal = NearestBranch(arm_, X_BF, seed.data(), {options_});
    const Correction solved = CorrectPose(arm_, X_BF, nominal.q.data(), options_);
    return Fill(nominal.q.data(), X_BF, solved, result);
  }

  // @param q_nominal where the nominal flange is at X_BF.
  Refused Fill(const double* q_nominal, const Pose& X_BF, const Correction& solved,
               v1::CompensatedTarget* result) {
    if (solved.outcome != Outcome::kOk) return RefusedFor(solved);
    before_ = Eigen::Map<const Eigen::VectorXd>(q_nominal, robot_.joint_count());
    for (int i = 0; i < robot_.joint_count(); ++i) result->add_joints(solved.q[i]);
    *result->mutable_pose() = ToProto(NominalFlange(arm_, solved.q.data()) * X_FT_);
    SetCorrection(X_BF * X_FT_, IdentifiedFlange(arm_, q_nominal) * X_FT_, result);
    result->set_residual_position_mm(solved.position_error_m * kMmPerM);
    result->set_iterations(solved.iterations);
    return {};
  }

  static void SetCorrection(const Pose& desired, const Pose& uncompensated,
                            v1::CompensatedTarget* result) {
    result->set_position_correction_mm((desired.p - uncompensated.p).norm() * kMmPerM);
    result->set_rotation_correction_deg(
        LogRotation<double>(desired.R * uncompensated.R.transpose()).norm() * kDegPerRad);
  }

  // Near a singularity joints may be known that would be right, but that are far away.
  static bool IsSolved(const Correction& solved) {
    return solved.position_error_m < kNothingLeft && solved.rotation_error_rad < kNothingLeft;
  }

  // What is wrong, by how much, and what to do.
  Refused RefusedFor(const Correction& solved) const {
    const std::string left =
        absl::StrFormat("%.3g mm and %.3g deg are left", solved.position_error_m * kMmPerM,
                        solved.rotation_error_rad * kDegPerRad);
    switch (solved.outcome) {
      case Outcome::kBeyondLimit:
        return {v1::COMPENSATION_BEYOND_LIMIT,
                absl::StrCat("the compensated joint ", LimitsOf(solved.joint), ": at best ", left,
                             "; move the target away from this limit or choose another "
                             "configuration"),
                solved.joint};
      case Outcome::kNearSingular:
        return {v1::COMPENSATION_NEAR_SINGULAR,
                absl::StrCat("near a singularity",
                             IsSolved(solved) ? "" : absl::StrCat(" (at best ", left, ")"),
                             ": joints would have to move far; move the target or choose another "
                             "configuration")};
      case Outcome::kInvalidArgument:
        return {v1::COMPENSATION_INVALID_TARGET, "values that are neither joints nor a pose"};
      default:
        return {v1::COMPENSATION_UNREACHABLE,
                absl::StrCat("out of reach: at best ", left, "; move the target")};
    }
  }

  std::string LimitsOf(int i) const {
    const Joint& joint = robot_.joints()[i];
    const bool angle = joint.type == JointType::kRevolute;
    const double scale = angle ? kDegPerRad : kMmPerM;
    return absl::StrCat(joint.name, " is beyond its limits ", joint.lower * scale, " to ",
                        joint.upper * scale, angle ? " deg" : " mm");
  }

  Refused CheckLimits(const double* q) const {
    for (int i = 0; i < robot_.joint_count(); ++i) {
      const Joint& joint = robot_.joints()[i];
      if (q[i] >= joint.lower && q[i] <= joint.upper) continue;
      const double scale = joint.type == JointType::kRevolute ? kDegPerRad : kMmPerM;
      return {v1::COMPENSATION_BEYOND_LIMIT,
              absl::StrCat("the target's ", q[i] * scale, " of joint ", LimitsOf(i)), i};
    }
    return {};
  }

  const Robot& robot_;
  const compensation::Arm& arm_;
  const Pose X_FT_;
  ExactOptions options_;
  Eigen::VectorXd before_;  // nominal joints of the last target that was compensated
};

absl::StatusOr<Pose> ToolOf(const v1::Nominal& nominal, const std::string& name) {
  if (name.empty()) return Pose{};
  return ToolByName(nominal, name, "tool");
}

}  // namespace

absl::StatusOr<v1::CompensateResponse> RunCompensation(const v1::Nominal& nominal,
                                                       const v1::Calibration& calibration,
                                                       const v1::CompensateRequest& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Robot robot, RobotFrom(nominal));
  TRUEPOSE_ASSIGN_OR_RETURN(const CalibratedArm calibrated,
                            CalibratedArmFrom(nominal, calibration));
  TRUEPOSE_RETURN_IF_ERROR(CheckTargets(request, robot.joint_count()));
  TRUEPOSE_ASSIGN_OR_RETURN(const Pose X_FT, ToolOf(nominal, request.tool()));
  Compensator compensator(robot, calibrated.arm, X_FT);
  v1::CompensateResponse response;
  for (const v1::CompensationTarget& target : request.targets())
    *response.add_targets() = compensator.Run(target);
  return response;
}

}  // namespace truepose::convert
