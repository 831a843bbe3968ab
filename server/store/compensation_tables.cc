#include "server/store/compensation_tables.h"

#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "server/store/calibrations.h"
#include "server/store/files.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/resources.h"
#include "server/store/robots.h"
#include "server/store/table_files.h"

namespace truepose::store {
namespace {

absl::StatusOr<ResourceKey> KeyOf(std::string_view name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const TableName parsed, ParseTableName(name));
  return ResourceKey{v1::KIND_COMPENSATION_TABLE, parsed.robot_id, parsed.id};
}

}  // namespace

absl::StatusOr<v1::CompensationTable> GetTable(Snapshot& snapshot, std::string_view name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const ResourceKey key, KeyOf(name));
  TRUEPOSE_ASSIGN_OR_RETURN(const std::optional<std::string> bytes, FindResource(snapshot, key));
  if (!bytes.has_value()) return NotFound(name);
  v1::CompensationTable table;
  if (table.ParseFromString(*bytes)) return table;
  return absl::DataLossError("a stored compensation table can't be read");
}

absl::Status PutTable(Transaction& transaction, v1::CompensationTable& table) {
  TRUEPOSE_ASSIGN_OR_RETURN(const ResourceKey key, KeyOf(table.name()));
  *table.mutable_update_time() = ToTimestamp(transaction.now());
  table.set_revision(transaction.revision());
  table.set_etag(ToEtag(transaction.revision()));
  return PutResource(transaction, key, table.name(), table, table.has_delete_time());
}

absl::StatusOr<v1::CompensationTableInput> LoadTableInput(Snapshot& snapshot,
                                                          const v1::CalibrationJob& job) {
  v1::CompensationTableInput input;
  TRUEPOSE_ASSIGN_OR_RETURN(v1::CompensationTable table,
                            GetTable(snapshot, job.compensation_table()));
  TRUEPOSE_ASSIGN_OR_RETURN(*input.mutable_calibration(),
                            GetCalibration(snapshot, table.calibration()));
  TRUEPOSE_ASSIGN_OR_RETURN(v1::NominalRevision revision,
                            GetNominalRevision(snapshot, input.calibration().nominal_revision()));
  input.set_robot(job.robot());
  *input.mutable_nominal() = std::move(*revision.mutable_nominal());
  *input.mutable_spec() = std::move(*table.mutable_spec());
  *input.mutable_create_time() = table.create_time();
  return input;
}

absl::StatusOr<v1::CompensationTable> FinishTable(Transaction& transaction,
                                                  const v1::CalibrationJob& job,
                                                  const TableFile& file) {
  TRUEPOSE_ASSIGN_OR_RETURN(v1::CompensationTable table,
                            GetTable(transaction, job.compensation_table()));
  TRUEPOSE_RETURN_IF_ERROR(PutFile(transaction, file.sha256, file.bytes));
  table.set_state(v1::TABLE_READY);
  table.set_size_bytes(static_cast<int64_t>(file.bytes.size()));
  table.set_sha256(file.sha256);
  *table.mutable_header() = file.header;
  TRUEPOSE_RETURN_IF_ERROR(PutTable(transaction, table));
  TRUEPOSE_RETURN_IF_ERROR(NoteTableFile(transaction, table));
  return table;
}

}  // namespace truepose::store
