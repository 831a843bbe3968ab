#include "server/store/release.h"

#include "core/base/status_macros.h"
#include "server/store/calibrations.h"
#include "server/store/events.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/sql/query.h"

namespace truepose::store {
namespace {

absl::Status Insert(Transaction& transaction, const NumberedName& key,
                    const v1::ReleaseStep& step) {
  return sql::Run(transaction.sql(),
                  "INSERT INTO release_steps (sequence, robot_id, number, state, revision, "
                  "message) VALUES ((SELECT COALESCE(MAX(sequence), 0) + 1 FROM release_steps), "
                  "$1, $2, $3, $4, $5)",
                  key.robot_id, key.number, static_cast<int>(step.state()), transaction.revision(),
                  sql::BlobView{ToBlob(step)});
}

}  // namespace

absl::StatusOr<v1::Calibration> AppendReleaseStep(Transaction& transaction, std::string_view name,
                                                  v1::ReleaseState state,
                                                  const std::string& principal,
                                                  const std::string& reason) {
  TRUEPOSE_ASSIGN_OR_RETURN(const NumberedName key, ParseCalibrationName(name));
  v1::ReleaseStep step;
  step.set_state(state);
  step.set_principal(principal);
  step.set_reason(reason);
  *step.mutable_time() = ToTimestamp(transaction.now());
  TRUEPOSE_RETURN_IF_ERROR(Insert(transaction, key, step));
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Calibration calibration, GetCalibration(transaction, name));
  calibration.clear_residuals();
  calibration.clear_covariance();
  TRUEPOSE_RETURN_IF_ERROR(RecordEvent(transaction,
                                       {.kind = v1::KIND_CALIBRATION,
                                        .robot_id = key.robot_id,
                                        .name = calibration.name(),
                                        .deleted = false},
                                       calibration));
  return calibration;
}

absl::Status FillRelease(Snapshot& snapshot, v1::Calibration& calibration) {
  TRUEPOSE_ASSIGN_OR_RETURN(const NumberedName key, ParseCalibrationName(calibration.name()));
  calibration.set_state(v1::DRAFT);
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto rows, sql::Query(snapshot.sql(),
                            "SELECT revision, message FROM release_steps WHERE robot_id = $1 AND "
                            "number = $2 ORDER BY sequence",
                            key.robot_id, key.number));
  for (;;) {
    TRUEPOSE_ASSIGN_OR_RETURN(const bool found, rows->Step());
    if (!found) break;
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::ReleaseStep step, ReadMessage<v1::ReleaseStep>(*rows, 1));
    calibration.set_state(step.state());
    calibration.set_revision(rows->Int64(0));
    *calibration.add_release_steps() = step;
  }
  calibration.set_etag(ToEtag(calibration.revision()));
  return absl::OkStatus();
}

absl::StatusOr<std::optional<absl::Time>> ActivationTime(Snapshot& snapshot,
                                                         std::string_view name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const NumberedName key, ParseCalibrationName(name));
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto row, sql::Query(snapshot.sql(),
                           "SELECT message FROM release_steps WHERE robot_id = $1 AND number = $2 "
                           "AND state = $3 ORDER BY sequence DESC LIMIT 1",
                           key.robot_id, key.number, static_cast<int>(v1::ACTIVE)));
  TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
  if (!found) return std::optional<absl::Time>();
  TRUEPOSE_ASSIGN_OR_RETURN(const auto step, ReadMessage<v1::ReleaseStep>(*row, 0));
  return std::optional(ToTime(step.time()));
}

absl::StatusOr<std::optional<std::string>> PreviouslyActive(Snapshot& snapshot,
                                                            const std::string& robot_id,
                                                            std::string_view active) {
  TRUEPOSE_ASSIGN_OR_RETURN(const NumberedName key, ParseCalibrationName(active));
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto row,
      sql::Query(snapshot.sql(),
                 "SELECT number FROM release_steps WHERE robot_id = $1 AND state = $2 AND "
                 "number <> $3 AND sequence < (SELECT MAX(sequence) FROM release_steps WHERE "
                 "robot_id = $1 AND state = $2 AND number = $3) ORDER BY sequence DESC LIMIT 1",
                 robot_id, static_cast<int>(v1::ACTIVE), key.number));
  TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
  if (!found) return std::optional<std::string>();
  return std::optional(CalibrationName(robot_id, row->Int64(0)));
}

}  // namespace truepose::store
