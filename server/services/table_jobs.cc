#include "server/services/table_jobs.h"

#include <optional>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "convert/table_spec.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "google/protobuf/util/message_differencer.h"
#include "server/jobs/transitions.h"
#include "server/services/stored_resources.h"
#include "server/store/calibrations.h"
#include "server/store/checksum.h"
#include "server/store/compensation_tables.h"
#include "server/store/jobs.h"
#include "server/store/names.h"
#include "server/store/resources.h"
#include "server/store/robots.h"

namespace truepose::services {
namespace {

using store::Snapshot;
using store::Transaction;
using Table = v1::CompensationTable;

constexpr char kField[] = "compensation_table";

absl::Status NoTableOf(const v1::Calibration& calibration, const std::string& why,
                       const std::string& expected) {
  return store::Refusal(absl::StatusCode::kFailedPrecondition, "compensation_table.calibration",
                        absl::StrCat(calibration.name(), ", ", why), expected);
}

absl::StatusOr<store::ResourceKey> KeyOf(const NewTable& wanted) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string robot_id, store::ParseRobotName(wanted.robot));
  const std::string id = wanted.id.empty() ? store::NewUuid() : wanted.id;
  return store::ResourceKey{v1::KIND_COMPENSATION_TABLE, robot_id, id};
}

// The table as it will be stored, but for what each state sets.
absl::StatusOr<Table> Describe(Snapshot& snapshot, const NewTable& wanted) {
  Table table;
  const v1::Calibration& calibration = wanted.calibration;
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::NominalRevision revision,
                            store::GetNominalRevision(snapshot, calibration.nominal_revision()));
  table.set_calibration(calibration.name());
  *table.mutable_spec() = wanted.spec;
  table.set_calibration_digest(calibration.digest());
  table.set_nominal_digest(revision.digest());
  table.set_input_digest(
      convert::TableInputDigest(calibration.digest(), revision.digest(), wanted.spec));
  table.set_created_by(wanted.created_by);
  return table;
}

// One that is there or on its way, so that nothing is built twice.
absl::StatusOr<std::optional<Table>> FindEqual(Snapshot& snapshot, const std::string& robot,
                                               const Table& wanted) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::vector<Table> tables, AllOfRobot<Table>(snapshot, robot));
  for (const Table& table : tables) {
    const bool usable = table.state() == v1::TABLE_READY || table.state() == v1::TABLE_BUILDING;
    if (usable && table.calibration() == wanted.calibration() &&
        table.input_digest() == wanted.input_digest())
      return std::optional(table);
  }
  return std::optional<Table>();
}

// The job of a table that is stored.
absl::Status StoreJob(Transaction& transaction, const NewTable& wanted, const Table& table) {
  v1::CalibrationJob job;
  job.set_robot(wanted.robot);
  job.set_nominal_revision(wanted.calibration.nominal_revision());
  job.set_input_digest(table.input_digest());
  job.set_compensation_table(table.name());
  job.set_priority(wanted.priority);
  job.set_created_by(wanted.created_by);
  job.set_created_by_machine(wanted.created_by_machine);
  TRUEPOSE_ASSIGN_OR_RETURN(const store::TableName name, store::ParseTableName(table.name()));
  return store::CreateJob(transaction, name.id, job).status();
}

absl::Status StoreFailed(Transaction& transaction, const NewTable& wanted,
                         const absl::Status& error) {
  TRUEPOSE_ASSIGN_OR_RETURN(const store::ResourceKey key, KeyOf(wanted));
  TRUEPOSE_ASSIGN_OR_RETURN(Table content, Describe(transaction, wanted));
  content.set_state(v1::TABLE_FAILED);
  *content.mutable_error() = jobs::ToJobError(error);
  content.set_name(store::CompensationTableName(key.robot_id, key.id));
  resource::StampNew(transaction, content.name(), content);
  return store::PutResource(transaction, key, content.name(), content, false);
}

// Whether `table` comes before `chosen`, which is older.
bool IsPreferred(const v1::Robot& robot, const Table& table, const std::optional<Table>& chosen) {
  if (!chosen.has_value() || !robot.has_table_spec()) return true;
  const auto is_by_spec = [&](const Table& one) {
    return google::protobuf::util::MessageDifferencer::Equals(
        convert::CompleteTableSpec(one.spec()), convert::CompleteTableSpec(robot.table_spec()));
  };
  return is_by_spec(table) || !is_by_spec(*chosen);
}

}  // namespace

absl::Status CheckMayHaveTable(const v1::Calibration& calibration, bool allow_draft) {
  if (calibration.state() == v1::REJECTED)
    return NoTableOf(calibration, "which is REJECTED", "one that may be used");
  if (calibration.report().verdict() == "do_not_apply")
    return NoTableOf(calibration, "whose verdict is do_not_apply", "one that may be applied");
  if (calibration.state() == v1::DRAFT && !allow_draft)
    return NoTableOf(calibration, "which is a DRAFT", "an approved one, or allow_draft");
  return absl::OkStatus();
}

absl::StatusOr<v1::CompensationTableInput> InputOf(Snapshot& snapshot, const NewTable& wanted) {
  v1::CompensationTableInput input;
  TRUEPOSE_ASSIGN_OR_RETURN(
      v1::NominalRevision revision,
      store::GetNominalRevision(snapshot, wanted.calibration.nominal_revision()));
  FaultList faults;
  const absl::Status valid = convert::ValidateTableSpec(revision.nominal(), wanted.spec);
  if (!valid.ok()) faults.AddAll(valid, absl::StrCat(kField, ".spec."));
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  input.set_robot(wanted.robot);
  *input.mutable_nominal() = std::move(*revision.mutable_nominal());
  *input.mutable_calibration() = wanted.calibration;
  *input.mutable_spec() = wanted.spec;
  return input;
}

absl::StatusOr<Table> QueueTable(Transaction& transaction, const NewTable& wanted) {
  TRUEPOSE_RETURN_IF_ERROR(InputOf(transaction, wanted).status());
  TRUEPOSE_ASSIGN_OR_RETURN(const store::ResourceKey key, KeyOf(wanted));
  TRUEPOSE_ASSIGN_OR_RETURN(Table content, Describe(transaction, wanted));
  TRUEPOSE_ASSIGN_OR_RETURN(const auto there, store::FindResource(transaction, key));
  if (!there.has_value()) {
    TRUEPOSE_ASSIGN_OR_RETURN(std::optional<Table> equal,
                              FindEqual(transaction, wanted.robot, content));
    if (equal.has_value()) return *std::move(equal);
  }
  content.set_state(v1::TABLE_BUILDING);
  content.set_job(store::JobName(key.id));
  Table table;
  TRUEPOSE_RETURN_IF_ERROR(
      resource::Create(transaction, TypeOf<Table>(), key, content, kField, table));
  if (!there.has_value()) TRUEPOSE_RETURN_IF_ERROR(StoreJob(transaction, wanted, table));
  return table;
}

absl::Status QueueActiveTable(Transaction& transaction, const v1::Robot& robot,
                              const std::string& principal, bool is_machine) {
  if (!robot.has_table_spec() || robot.active_calibration().empty()) return absl::OkStatus();
  NewTable wanted{.robot = robot.name(),
                  .id = "",
                  .calibration = {},
                  .spec = convert::StoredTableSpec(robot.table_spec()),
                  .created_by = principal,
                  .created_by_machine = is_machine};
  TRUEPOSE_ASSIGN_OR_RETURN(wanted.calibration,
                            store::GetCalibration(transaction, robot.active_calibration()));
  absl::Status possible = CheckMayHaveTable(wanted.calibration, false);
  if (possible.ok()) possible = InputOf(transaction, wanted).status();
  if (!possible.ok()) return StoreFailed(transaction, wanted, possible);
  return QueueTable(transaction, wanted).status();
}

absl::StatusOr<std::string> TableToApply(Snapshot& snapshot, const v1::Robot& robot) {
  if (robot.active_calibration().empty()) return std::string();
  TRUEPOSE_ASSIGN_OR_RETURN(const std::vector<Table> tables,
                            AllOfRobot<Table>(snapshot, robot.name()));
  std::optional<Table> chosen;
  for (const Table& table : tables) {
    const bool usable =
        table.state() == v1::TABLE_READY && table.calibration() == robot.active_calibration();
    if (usable && IsPreferred(robot, table, chosen)) chosen = table;
  }
  return chosen.has_value() ? chosen->name() : std::string();
}

absl::Status RefreshTableToApply(Transaction& transaction, const std::string& name) {
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Robot robot, store::GetRobot(transaction, name));
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string table, TableToApply(transaction, robot));
  if (table == robot.active_compensation_table()) return absl::OkStatus();
  robot.set_active_compensation_table(table);
  return store::PutRobot(transaction, robot).status();
}

absl::Status EndTableJob(Transaction& transaction, const v1::CalibrationJob& job) {
  if (job.compensation_table().empty()) return absl::OkStatus();
  if (job.state() == v1::SUCCEEDED) return RefreshTableToApply(transaction, job.robot());
  TRUEPOSE_ASSIGN_OR_RETURN(Table table, store::GetTable(transaction, job.compensation_table()));
  table.set_state(v1::TABLE_FAILED);
  *table.mutable_error() = job.state() == v1::CANCELLED
                               ? jobs::ToJobError(absl::CancelledError("its job was cancelled"))
                               : job.error();
  return store::PutTable(transaction, table);
}

}  // namespace truepose::services
