#include "server/services/compensation_tables.h"

#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/time/time.h"
#include "convert/table_spec.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/resource/resource_name.h"
#include "server/services/closures.h"
#include "server/services/live.h"
#include "server/services/stored_resources.h"
#include "server/services/table_jobs.h"
#include "server/store/calibrations.h"
#include "server/store/compensation_tables.h"
#include "server/store/files.h"
#include "server/store/jobs.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/table_files.h"

namespace truepose::services {
namespace {

using store::Snapshot;
using store::Transaction;
using Table = v1::CompensationTable;
using CreateRequest = v1::CreateCompensationTableRequest;

constexpr char kCalibration[] = "compensation_table.calibration";

absl::Status CheckRequest(const CreateRequest& request) {
  FaultList faults;
  faults.AddAll(resource::MakeKey(TypeOf<Table>(), request.parent(),
                                  request.compensation_table_id(), "compensation_table_id")
                    .status());
  const std::string& calibration = request.compensation_table().calibration();
  if (!calibration.empty())
    faults.AddAll(store::ParseCalibrationName(calibration, kCalibration).status());
  if (request.priority() < store::kLowestPriority || request.priority() > store::kHighestPriority)
    faults.Add("priority", absl::StrCat(request.priority()),
               absl::StrCat(store::kLowestPriority, " to ", store::kHighestPriority));
  return faults.ToStatus();
}

// The calibration that was asked for, of that robot, or the active one.
absl::StatusOr<v1::Calibration> CalibrationOf(Snapshot& snapshot, const CreateRequest& request,
                                              const v1::Robot& robot) {
  const std::string& asked = request.compensation_table().calibration();
  const std::string& name = asked.empty() ? robot.active_calibration() : asked;
  if (name.empty()) {
    return store::Refusal(absl::StatusCode::kFailedPrecondition, kCalibration, "nothing",
                          absl::StrCat("a calibration: none of ", robot.name(), " is active"));
  }
  if (!name.starts_with(robot.name() + "/"))
    return FaultStatus(kCalibration, name, absl::StrCat("a calibration of ", robot.name()));
  auto calibration = store::GetCalibration(snapshot, name);
  if (absl::IsNotFound(calibration.status())) return store::NotFound(name, kCalibration);
  return calibration;
}

absl::StatusOr<NewTable> WantedBy(Snapshot& snapshot, const Caller& caller,
                                  const CreateRequest& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot,
                            GetLiveRobot(snapshot, request.parent(), "parent"));
  NewTable wanted{.robot = robot.name(),
                  .id = request.compensation_table_id(),
                  .calibration = {},
                  .spec = convert::StoredTableSpec(robot.table_spec()),
                  .created_by = caller.principal,
                  .created_by_machine = caller.is_machine,
                  .priority = request.priority()};
  if (request.compensation_table().has_spec()) wanted.spec = request.compensation_table().spec();
  TRUEPOSE_ASSIGN_OR_RETURN(wanted.calibration, CalibrationOf(snapshot, request, robot));
  TRUEPOSE_RETURN_IF_ERROR(CheckMayHaveTable(wanted.calibration, request.allow_draft()));
  return wanted;
}

// Computes outside of the store.
absl::StatusOr<Table> Estimate(const CallContext& call, const CreateRequest& request) {
  v1::CompensationTableInput input;
  TRUEPOSE_ASSIGN_OR_RETURN(
      const NewTable wanted, call.store.Read([&](Snapshot& snapshot) -> absl::StatusOr<NewTable> {
        TRUEPOSE_ASSIGN_OR_RETURN(NewTable one, WantedBy(snapshot, call.caller, request));
        TRUEPOSE_ASSIGN_OR_RETURN(input, InputOf(snapshot, one));
        return one;
      }));
  Table table;
  const auto estimate = call.engine.EstimateTable(input);
  FaultList faults;
  if (!FaultsOf(estimate.status()).empty())
    faults.AddAll(estimate.status(), "compensation_table.spec.");
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus(estimate.status().code()));
  TRUEPOSE_ASSIGN_OR_RETURN(*table.mutable_estimate(), estimate);
  table.set_name(absl::StrCat(request.parent(), "/compensationTables/", wanted.id));
  table.set_calibration(wanted.calibration.name());
  *table.mutable_spec() = wanted.spec;
  return table;
}

absl::StatusOr<Table> Queue(Transaction& transaction, const Caller& caller,
                            const CreateRequest& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(const NewTable wanted, WantedBy(transaction, caller, request));
  return QueueTable(transaction, wanted);
}

std::string WhyNotIt(const Table& table) {
  if (table.has_delete_time())
    return absl::StrCat(table.calibration(), ": its table was deleted, ", table.name());
  if (table.state() == v1::TABLE_FAILED)
    return absl::StrCat(table.name(), ", which FAILED: ", table.error().message());
  return absl::StrCat(table.name(), ", which is still BUILDING by ", table.job());
}

// In words, for whoever waits for a table.
absl::StatusOr<std::string> WhyNone(Snapshot& snapshot, const v1::Robot& robot) {
  if (robot.active_calibration().empty())
    return absl::StrCat(robot.name(), ", which has no active calibration");
  TRUEPOSE_ASSIGN_OR_RETURN(
      const std::vector<Table> tables,
      AllOfRobot<Table>(snapshot, robot.name(), /*only_open=*/false, /*show_deleted=*/true));
  std::string why, deleted;
  for (const Table& table : tables) {
    if (table.calibration() != robot.active_calibration()) continue;
    (table.has_delete_time() ? deleted : why) = WhyNotIt(table);
  }
  if (!why.empty()) return why;
  if (!deleted.empty()) return deleted;
  return absl::StrCat(robot.active_calibration(), ", of which no table was asked for");
}

absl::StatusOr<Table> Active(Snapshot& snapshot, const std::string& name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot, GetLiveRobot(snapshot, name, "robot"));
  if (!robot.active_compensation_table().empty())
    return store::GetTable(snapshot, robot.active_compensation_table());
  TRUEPOSE_ASSIGN_OR_RETURN(std::string why, WhyNone(snapshot, robot));
  return store::Refusal(absl::StatusCode::kNotFound, "robot", std::move(why),
                        "a robot with a READY table of its active calibration");
}

absl::StatusOr<Table> Delete(Transaction& transaction,
                             const v1::DeleteCompensationTableRequest& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(Table table, GetResource<Table>(transaction, request.name()));
  if (table.state() == v1::TABLE_BUILDING) {
    return store::Refusal(absl::StatusCode::kFailedPrecondition, "name",
                          absl::StrCat(table.name(), ", which is BUILDING"),
                          absl::StrCat("one that is READY or FAILED; cancel ", table.job()));
  }
  TRUEPOSE_RETURN_IF_ERROR(
      resource::Delete(transaction, TypeOf<Table>(), request.name(), request.etag(), table));
  TRUEPOSE_RETURN_IF_ERROR(store::NoteTableFile(transaction, table));
  const std::string robot = request.name().substr(0, request.name().find("/compensationTables/"));
  TRUEPOSE_RETURN_IF_ERROR(RefreshTableToApply(transaction, robot));
  return table;
}

// Of a deleted table too, for as long as it can be brought back.
absl::Status CheckHasBytes(Snapshot& snapshot, const Table& table) {
  if (table.state() != v1::TABLE_READY) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(const bool there, store::HasFile(snapshot, table.sha256()));
  if (there) return absl::OkStatus();
  return store::Refusal(
      absl::StatusCode::kFailedPrecondition, "name",
      absl::StrCat(table.name(), ", which was deleted at ",
                   absl::FormatTime(absl::RFC3339_sec, store::ToTime(table.delete_time()),
                                    absl::UTCTimeZone()),
                   " and whose bytes are gone"),
      "one deleted within 7 days; built again from the same input it is the same");
}

absl::StatusOr<Table> Undelete(Transaction& transaction, const std::string& name) {
  TRUEPOSE_ASSIGN_OR_RETURN(Table table, GetResource<Table>(transaction, name));
  TRUEPOSE_RETURN_IF_ERROR(CheckHasBytes(transaction, table));
  TRUEPOSE_RETURN_IF_ERROR(resource::Undelete(transaction, TypeOf<Table>(), name, table));
  TRUEPOSE_RETURN_IF_ERROR(store::NoteTableFile(transaction, table));
  TRUEPOSE_RETURN_IF_ERROR(
      RefreshTableToApply(transaction, name.substr(0, name.find("/compensationTables/"))));
  return table;
}

}  // namespace

absl::StatusOr<Table> CreateCompensationTable(const CallContext& call,
                                              const CreateRequest& request) {
  TRUEPOSE_RETURN_IF_ERROR(CheckRequest(request));
  if (request.validate_only()) return Estimate(call, request);
  auto table = WriteOnce(call, request, [&](Transaction& transaction) {
    return Queue(transaction, call.caller, request);
  });
  if (table.ok()) call.engine.Wake();
  return table;
}

absl::StatusOr<Table> GetActiveCompensationTable(
    const CallContext& call, const v1::GetActiveCompensationTableRequest& request) {
  return call.store.Read([&](Snapshot& snapshot) { return Active(snapshot, request.robot()); });
}

absl::StatusOr<Table> DeleteCompensationTable(const CallContext& call,
                                              const v1::DeleteCompensationTableRequest& request) {
  return WriteOnce(call, request,
                   [&](Transaction& transaction) { return Delete(transaction, request); });
}

absl::StatusOr<Table> UndeleteCompensationTable(
    const CallContext& call, const v1::UndeleteCompensationTableRequest& request) {
  return WriteOnce(call, request,
                   [&](Transaction& transaction) { return Undelete(transaction, request.name()); });
}

}  // namespace truepose::services
