#include "server/services/release_rules.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "server/store/message.h"

namespace truepose::services {
namespace {

absl::Status Denied(const std::string& found, const std::string& expected) {
  return store::Refusal(absl::StatusCode::kPermissionDenied, "principal", found, expected);
}

bool NeedsTwo(const Caller& caller, const v1::Robot& robot) {
  return !caller.is_local_dev && robot.release_policy() != v1::ONE_PERSON;
}

bool MayFollow(v1::ReleaseState from, v1::ReleaseState to) {
  switch (to) {
    case v1::APPROVED:
      return from == v1::DRAFT;
    case v1::REJECTED:
      return from == v1::DRAFT || from == v1::APPROVED;
    case v1::ACTIVE:
      return from == v1::APPROVED || from == v1::SUPERSEDED;
    case v1::SUPERSEDED:
      return from == v1::ACTIVE;
    default:
      return false;
  }
}

}  // namespace

absl::Status CheckIsPerson(const Caller& caller) {
  if (!caller.is_machine) return absl::OkStatus();
  return Denied(absl::StrCat(caller.principal, ", which is a machine"), "a person's token");
}

absl::Status CheckIsAdmin(const Caller& caller) {
  if (caller.is_admin) return absl::OkStatus();
  return Denied(absl::StrCat(caller.principal, ", who is no admin"),
                "an admin's token: release policy and its limits decide who releases");
}

absl::Status CheckMayApprove(const Caller& caller, const v1::Robot& robot, const Origin& origin) {
  const absl::Status person = CheckIsPerson(caller);
  if (!person.ok() || !NeedsTwo(caller, robot)) return person;
  const bool made_by_caller =
      !origin.job.created_by_machine() && origin.job.created_by() == caller.principal;
  if (made_by_caller) {
    return Denied(absl::StrCat(caller.principal, ", who created ", origin.job.name()),
                  "a second person (the robot's release policy is TWO_PERSON)");
  }
  for (const v1::Session& session : origin.sessions) {
    if (session.sealed_by() != caller.principal) continue;
    return Denied(absl::StrCat(caller.principal, ", who sealed ", session.name()),
                  "a second person (the robot's release policy is TWO_PERSON)");
  }
  return absl::OkStatus();
}

absl::Status CheckReleaseStep(const v1::Calibration& calibration, v1::ReleaseState to) {
  if (MayFollow(calibration.state(), to)) return absl::OkStatus();
  return store::Refusal(
      absl::StatusCode::kFailedPrecondition, "name",
      absl::StrCat(calibration.name(), ", which is ", v1::ReleaseState_Name(calibration.state())),
      absl::StrCat("a calibration that may become ", v1::ReleaseState_Name(to),
                   " (draft -> approved | rejected, approved -> active)"));
}

absl::Status CheckVerdict(const v1::Calibration& calibration) {
  const v1::CalibrationReport& report = calibration.report();
  if (report.verdict() != "do_not_apply") return absl::OkStatus();
  const std::string reasons = absl::StrJoin(report.verdict_reasons(), "; ");
  return store::Refusal(absl::StatusCode::kFailedPrecondition, "name",
                        absl::StrCat(calibration.name(), ", whose verdict is do_not_apply",
                                     reasons.empty() ? "" : absl::StrCat(" (", reasons, ")")),
                        "a calibration that may be applied: reject this one, and calibrate again");
}

std::string WhyNotAutomatic(const v1::Robot& robot, const v1::Calibration& calibration,
                            double change_mm) {
  const v1::RobotLimits& limits = robot.limits();
  const double control = calibration.report().sets().control().after().position_mm().rms();
  if (robot.release_policy() != v1::AUTOMATIC_WITHIN_LIMITS) return "the policy asks for a person";
  if (calibration.report().verdict() != "apply")
    return absl::StrCat("the verdict is ", calibration.report().verdict());
  if (limits.control_rms_mm() <= 0.0) return "the robot has no limit of the control RMS";
  if (calibration.report().sets().control().poses() == 0) return "there is no control set";
  if (control > limits.control_rms_mm())
    return absl::StrCat("the control RMS is ", control, " mm, the limit ", limits.control_rms_mm());
  if (limits.change_mm() > 0.0 && change_mm > limits.change_mm())
    return absl::StrCat("the flange moves by ", change_mm, " mm, the limit ", limits.change_mm());
  return "";
}

}  // namespace truepose::services
