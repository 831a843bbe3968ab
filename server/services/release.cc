#include "server/services/release.h"

#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "convert/flange_change.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/resource/etag.h"
#include "server/services/closures.h"
#include "server/services/live.h"
#include "server/services/release_rules.h"
#include "server/services/table_jobs.h"
#include "server/store/calibrations.h"
#include "server/store/jobs.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/release.h"
#include "server/store/robots.h"
#include "server/store/sessions.h"

namespace truepose::services {
namespace {

using store::Snapshot;
using store::Transaction;

constexpr char kServer[] = "server";

std::string RobotOf(const v1::Calibration& calibration) {
  return store::RobotName(store::ParseCalibrationName(calibration.name())->robot_id);
}

absl::StatusOr<Origin> OriginOf(Snapshot& snapshot, const v1::Calibration& calibration) {
  Origin origin;
  TRUEPOSE_ASSIGN_OR_RETURN(origin.job, store::GetJob(snapshot, calibration.job()));
  for (const std::string& name : calibration.sessions()) {
    TRUEPOSE_ASSIGN_OR_RETURN(v1::Session session, store::GetSession(snapshot, name));
    origin.sessions.push_back(std::move(session));
  }
  return origin;
}

// The calibration of a request whose etag, if any, is still right.
template <typename Request>
absl::StatusOr<v1::Calibration> Asked(Snapshot& snapshot, const Request& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Calibration calibration,
                            store::GetCalibration(snapshot, request.name()));
  TRUEPOSE_RETURN_IF_ERROR(resource::CheckEtag(calibration.etag(), request.etag()));
  return calibration;
}

absl::StatusOr<v1::Calibration> Approve(Transaction& transaction, const Caller& caller,
                                        const v1::ApproveCalibrationRequest& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Calibration calibration, Asked(transaction, request));
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot,
                            GetLiveRobot(transaction, RobotOf(calibration), "name"));
  TRUEPOSE_ASSIGN_OR_RETURN(const Origin origin, OriginOf(transaction, calibration));
  TRUEPOSE_RETURN_IF_ERROR(CheckReleaseStep(calibration, v1::APPROVED));
  TRUEPOSE_RETURN_IF_ERROR(CheckMayApprove(caller, robot, origin));
  TRUEPOSE_RETURN_IF_ERROR(CheckVerdict(calibration));
  return store::AppendReleaseStep(transaction, request.name(), v1::APPROVED, caller.principal,
                                  request.reason());
}

absl::Status CheckNominal(const v1::Robot& robot, const v1::Calibration& calibration) {
  if (robot.nominal_revision().name() == calibration.nominal_revision()) return absl::OkStatus();
  return store::Refusal(
      absl::StatusCode::kFailedPrecondition, "name",
      absl::StrCat(calibration.name(), " of ", calibration.nominal_revision()),
      absl::StrCat("a calibration of ", robot.nominal_revision().name(), ", the robot's latest"));
}

// Whether the server may make the step by itself. Where the flange's change can't be told, as
// between calibrations of different nominals, a person decides.
absl::StatusOr<bool> IsWithinLimits(Snapshot& snapshot, const v1::Robot& robot,
                                    const v1::Calibration& calibration) {
  if (calibration.state() != v1::DRAFT || robot.release_policy() != v1::AUTOMATIC_WITHIN_LIMITS ||
      !CheckNominal(robot, calibration).ok()) {
    return false;
  }
  if (robot.active_calibration().empty()) return WhyNotAutomatic(robot, calibration, -1.0).empty();
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Calibration active,
                            store::GetCalibration(snapshot, robot.active_calibration()));
  if (!CheckNominal(robot, active).ok()) return false;
  const absl::StatusOr<double> change =
      convert::FlangeChangeMm(robot.nominal_revision().nominal(), active, calibration);
  return change.ok() && WhyNotAutomatic(robot, calibration, *change).empty();
}

// Makes `name` the one that acts on the robot; the other one becomes superseded, and the table by
// the robot's table_spec is queued, in the same commit.
absl::StatusOr<v1::Calibration> MakeActive(Transaction& transaction, v1::Robot robot,
                                           const std::string& name, const std::string& principal,
                                           const std::string& reason) {
  if (!robot.active_calibration().empty()) {
    TRUEPOSE_RETURN_IF_ERROR(store::AppendReleaseStep(transaction, robot.active_calibration(),
                                                      v1::SUPERSEDED, principal,
                                                      absl::StrCat("by ", name))
                                 .status());
  }
  robot.set_active_calibration(name);
  TRUEPOSE_ASSIGN_OR_RETURN(*robot.mutable_active_compensation_table(),
                            TableToApply(transaction, robot));
  TRUEPOSE_RETURN_IF_ERROR(store::PutRobot(transaction, robot).status());
  TRUEPOSE_ASSIGN_OR_RETURN(
      v1::Calibration calibration,
      store::AppendReleaseStep(transaction, name, v1::ACTIVE, principal, reason));
  TRUEPOSE_RETURN_IF_ERROR(
      QueueActiveTable(transaction, robot, principal, /*is_machine=*/principal == kServer));
  return calibration;
}

absl::StatusOr<v1::Calibration> Activate(Transaction& transaction, const Caller& caller,
                                         const v1::ActivateCalibrationRequest& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Calibration calibration, Asked(transaction, request));
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot,
                            GetLiveRobot(transaction, RobotOf(calibration), "name"));
  TRUEPOSE_RETURN_IF_ERROR(CheckIsPerson(caller));
  TRUEPOSE_RETURN_IF_ERROR(CheckReleaseStep(calibration, v1::ACTIVE));
  TRUEPOSE_RETURN_IF_ERROR(CheckNominal(robot, calibration));
  return MakeActive(transaction, robot, request.name(), caller.principal, request.reason());
}

absl::StatusOr<v1::Calibration> RollBack(Transaction& transaction, const Caller& caller,
                                         const v1::RollBackCalibrationRequest& request) {
  TRUEPOSE_RETURN_IF_ERROR(CheckIsPerson(caller));
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot,
                            GetLiveRobot(transaction, request.robot(), "robot"));
  const std::string& active = robot.active_calibration();
  if (active.empty() || (!request.from().empty() && request.from() != active)) {
    return store::Refusal(absl::StatusCode::kFailedPrecondition, "from",
                          active.empty() ? "no active calibration" : active,
                          request.from().empty() ? "a robot with an active calibration"
                                                 : request.from() + " as the active one");
  }
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string robot_id, store::ParseRobotName(robot.name()));
  TRUEPOSE_ASSIGN_OR_RETURN(const std::optional<std::string> before,
                            store::PreviouslyActive(transaction, robot_id, active));
  if (!before.has_value()) {
    return store::Refusal(absl::StatusCode::kFailedPrecondition, "robot",
                          absl::StrCat(active, ", the first that was ever active"),
                          "a robot with an earlier active calibration");
  }
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Calibration target,
                            store::GetCalibration(transaction, *before));
  TRUEPOSE_RETURN_IF_ERROR(CheckNominal(robot, target));
  return MakeActive(transaction, robot, *before, caller.principal,
                    absl::StrCat("roll back. ", request.reason()));
}

}  // namespace

absl::StatusOr<v1::Calibration> ApproveCalibration(const CallContext& call,
                                                   const v1::ApproveCalibrationRequest& request) {
  return WriteOnce(call, request, [&](Transaction& transaction) {
    return Approve(transaction, call.caller, request);
  });
}

absl::StatusOr<v1::Calibration> RejectCalibration(const CallContext& call,
                                                  const v1::RejectCalibrationRequest& request) {
  TRUEPOSE_RETURN_IF_ERROR(CheckIsPerson(call.caller));
  if (request.reason().empty())
    return FaultStatus("reason", "nothing", "why it is rejected, for those who come after");
  return WriteOnce(call, request, [&](Transaction& transaction) -> absl::StatusOr<v1::Calibration> {
    TRUEPOSE_ASSIGN_OR_RETURN(const auto calibration, Asked(transaction, request));
    TRUEPOSE_RETURN_IF_ERROR(CheckReleaseStep(calibration, v1::REJECTED));
    return store::AppendReleaseStep(transaction, request.name(), v1::REJECTED,
                                    call.caller.principal, request.reason());
  });
}

absl::StatusOr<v1::Calibration> ActivateCalibration(const CallContext& call,
                                                    const v1::ActivateCalibrationRequest& request) {
  auto calibration = WriteOnce(call, request, [&](Transaction& transaction) {
    return Activate(transaction, call.caller, request);
  });
  if (calibration.ok()) call.engine.Wake();
  return calibration;
}

absl::StatusOr<v1::Calibration> RollBackCalibration(const CallContext& call,
                                                    const v1::RollBackCalibrationRequest& request) {
  auto calibration = WriteOnce(call, request, [&](Transaction& transaction) {
    return RollBack(transaction, call.caller, request);
  });
  if (calibration.ok()) call.engine.Wake();
  return calibration;
}

absl::Status ReleaseWithinLimits(Transaction& transaction, const v1::Calibration& calibration) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot,
                            store::GetRobot(transaction, RobotOf(calibration)));
  TRUEPOSE_ASSIGN_OR_RETURN(const bool releases, IsWithinLimits(transaction, robot, calibration));
  if (!releases) return absl::OkStatus();
  const std::string reason = "within the robot's limits";
  TRUEPOSE_RETURN_IF_ERROR(
      store::AppendReleaseStep(transaction, calibration.name(), v1::APPROVED, kServer, reason)
          .status());
  return MakeActive(transaction, robot, calibration.name(), kServer, reason).status();
}

}  // namespace truepose::services
