#include "server/services/table_spec_check.h"

#include <optional>
#include <string>
#include <utility>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"
#include "convert/table_domain.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "google/protobuf/util/message_differencer.h"
#include "server/resource/field_mask.h"
#include "server/resource/once.h"
#include "server/services/live.h"
#include "server/services/table_jobs.h"
#include "server/store/calibrations.h"

namespace truepose::services {
namespace {

using store::Snapshot;

constexpr absl::string_view kCreatedBelow = "compensation_table.spec.";

// Of what a table of the active calibration would be; nothing where there can be none.
absl::StatusOr<v1::CompensationTableInput> ActiveInput(Snapshot& snapshot, const v1::Robot& robot) {
  NewTable wanted{.robot = robot.name(),
                  .id = "",
                  .calibration = {},
                  .spec = robot.table_spec(),
                  .created_by = ""};
  TRUEPOSE_ASSIGN_OR_RETURN(wanted.calibration,
                            store::GetCalibration(snapshot, robot.active_calibration()));
  TRUEPOSE_RETURN_IF_ERROR(CheckMayHaveTable(wanted.calibration, false));
  return InputOf(snapshot, wanted);
}

absl::Status EstimateActive(const CallContext& call, const v1::Robot& robot) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      const v1::CompensationTableInput input,
      call.store.Read([&](Snapshot& snapshot) { return ActiveInput(snapshot, robot); }));
  return call.engine.EstimateTable(input).status();
}

bool IsOfCalibration(absl::string_view field) {
  return field == "calibration" || absl::StartsWith(field, "calibration.") ||
         absl::StrContains(field, ".calibration");
}

absl::Status BelowRobot(const absl::Status& status) {
  FaultList faults;
  for (const Fault& fault : FaultsOf(status)) {
    if (IsOfCalibration(fault.field)) continue;
    absl::string_view field = fault.field;
    absl::ConsumePrefix(&field, kCreatedBelow);
    faults.Add(absl::StrCat("robot.table_spec.", field), fault.found, fault.expected);
  }
  return faults.ToStatus();
}

// The robot with another spec than it has, unless this request was answered before.
absl::StatusOr<std::optional<v1::Robot>> WithNewSpec(Snapshot& snapshot, const Caller& caller,
                                                     const v1::UpdateRobotRequest& request) {
  if (!request.request_id().empty()) {
    const auto key = resource::KeyOf(caller.principal, request, request.request_id());
    TRUEPOSE_ASSIGN_OR_RETURN(const auto answered, store::FindReply(snapshot, key));
    if (answered.has_value()) return std::optional<v1::Robot>();
  }
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot before,
                            GetLiveRobot(snapshot, request.robot().name(), "robot.name"));
  v1::Robot after = before;
  TRUEPOSE_RETURN_IF_ERROR(
      resource::ApplyUpdate(request.robot(), request.update_mask(), {}, after));
  if (HasSameSpec(before, after)) return std::optional<v1::Robot>();
  *after.mutable_nominal_revision() = before.nominal_revision();
  after.set_active_calibration(before.active_calibration());
  return std::optional(std::move(after));
}

}  // namespace

bool HasSameSpec(const v1::Robot& before, const v1::Robot& after) {
  using google::protobuf::util::MessageDifferencer;
  return MessageDifferencer::Equals(before.table_spec(), after.table_spec()) &&
         before.has_table_spec() == after.has_table_spec();
}

absl::Status CheckSpecBuildable(const CallContext& call, const v1::Robot& robot) {
  if (!robot.has_table_spec()) return absl::OkStatus();
  const absl::Status of_nominal =
      BelowRobot(convert::CheckTableDomain(robot.nominal_revision().nominal(), robot.table_spec()));
  if (!of_nominal.ok() || robot.active_calibration().empty()) return of_nominal;
  return BelowRobot(EstimateActive(call, robot));
}

absl::Status CheckSpecBuildable(const CallContext& call, const v1::UpdateRobotRequest& request) {
  const absl::StatusOr<std::optional<v1::Robot>> robot = call.store.Read(
      [&](Snapshot& snapshot) { return WithNewSpec(snapshot, call.caller, request); });
  if (!robot.ok() || !robot->has_value()) return absl::OkStatus();
  return CheckSpecBuildable(call, **robot);
}

}  // namespace truepose::services
