#include "server/store/calibrations.h"

#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "server/store/keys.h"
#include "server/store/list.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/release.h"
#include "server/store/robots.h"
#include "server/store/sql/query.h"

namespace truepose::store {
namespace {

// Splits off what lists leave out. Merging both gives the whole again.
v1::Calibration TakeDetail(v1::Calibration& calibration) {
  v1::Calibration detail;
  detail.mutable_covariance()->Swap(calibration.mutable_covariance());
  detail.mutable_residuals()->Swap(calibration.mutable_residuals());
  return detail;
}

absl::StatusOr<int64_t> NextNumber(Snapshot& snapshot, const std::string& robot_id) {
  return sql::QueryInt64(
      snapshot.sql(), "SELECT COALESCE(MAX(number), 0) + 1 FROM calibrations WHERE robot_id = $1",
      robot_id);
}

// What must be equal to be stored once (calibrations.h): bytes that equal content has in common.
std::string Content(v1::Calibration calibration) {
  calibration.clear_name();
  calibration.clear_job();
  calibration.clear_created_by();
  calibration.clear_create_time();
  calibration.clear_provenance();
  calibration.clear_state();
  calibration.clear_release_steps();
  calibration.clear_revision();
  calibration.clear_etag();
  return ToBlob(calibration);
}

absl::StatusOr<std::optional<v1::Calibration>> FindEqual(Snapshot& snapshot,
                                                         const std::string& robot_id,
                                                         const std::string& input_digest,
                                                         const v1::Calibration& calibration) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto rows, sql::Query(snapshot.sql(),
                            "SELECT number FROM calibrations WHERE robot_id = $1 AND digest = $2 "
                            "AND input_digest = $3 ORDER BY number",
                            robot_id, calibration.digest(), input_digest));
  const std::string content = Content(calibration);
  for (;;) {
    TRUEPOSE_ASSIGN_OR_RETURN(const bool found, rows->Step());
    if (!found) return std::optional<v1::Calibration>();
    TRUEPOSE_ASSIGN_OR_RETURN(v1::Calibration stored,
                              GetCalibration(snapshot, CalibrationName(robot_id, rows->Int64(0))));
    if (Content(stored) == content) return std::optional(std::move(stored));
  }
}

absl::Status CheckNoCalibration(Snapshot& snapshot, Key job, const std::string& name) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      const int64_t count,
      sql::QueryInt64(snapshot.sql(), "SELECT COUNT(*) FROM calibrations WHERE job = $1", job));
  if (count == 0) return absl::OkStatus();
  return Refusal(absl::StatusCode::kAlreadyExists, "job",
                 absl::StrCat(name, ", which has a calibration"), "a job without one");
}

absl::Status Insert(Transaction& transaction, const NumberedName& name, Key job,
                    const std::string& input_digest, v1::Calibration calibration) {
  const v1::Calibration detail = TakeDetail(calibration);
  return sql::Run(transaction.sql(),
                  "INSERT INTO calibrations (robot_id, number, job, digest, input_digest, message, "
                  "detail) VALUES ($1, $2, $3, $4, $5, $6, $7)",
                  name.robot_id, name.number, job, calibration.digest(), input_digest,
                  sql::BlobView{ToBlob(calibration)}, sql::BlobView{ToBlob(detail)});
}

}  // namespace

absl::StatusOr<v1::Calibration> InsertCalibration(Transaction& transaction,
                                                  const v1::CalibrationJob& job,
                                                  const v1::Calibration& calibration) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Key key, JobKey(transaction, job.name(), "job"));
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string robot_id, ParseRobotName(job.robot(), "robot"));
  TRUEPOSE_RETURN_IF_ERROR(CheckNoCalibration(transaction, key, job.name()));
  v1::Calibration stored = calibration;
  *stored.mutable_options() = job.options();
  TRUEPOSE_ASSIGN_OR_RETURN(std::optional<v1::Calibration> equal,
                            FindEqual(transaction, robot_id, job.input_digest(), stored));
  if (equal.has_value()) return *std::move(equal);
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t number, NextNumber(transaction, robot_id));
  stored.set_name(CalibrationName(robot_id, number));
  stored.set_job(job.name());
  stored.set_created_by(job.created_by());
  *stored.mutable_create_time() = ToTimestamp(transaction.now());
  TRUEPOSE_RETURN_IF_ERROR(
      Insert(transaction, {robot_id, number}, key, job.input_digest(), stored));
  TRUEPOSE_RETURN_IF_ERROR(
      AppendReleaseStep(transaction, stored.name(), v1::DRAFT, job.created_by(), "").status());
  return GetCalibration(transaction, stored.name());
}

absl::StatusOr<v1::Calibration> GetCalibration(Snapshot& snapshot, std::string_view name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const NumberedName key, ParseCalibrationName(name));
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto row,
      sql::Query(snapshot.sql(),
                 "SELECT message, detail FROM calibrations WHERE robot_id = $1 AND number = $2",
                 key.robot_id, key.number));
  TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
  if (!found) return NotFound(name);
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Calibration calibration, ReadMessage<v1::Calibration>(*row, 0));
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Calibration detail, ReadMessage<v1::Calibration>(*row, 1));
  calibration.MergeFrom(detail);
  TRUEPOSE_RETURN_IF_ERROR(FillRelease(snapshot, calibration));
  return calibration;
}

absl::StatusOr<Page<v1::Calibration>> ListCalibrations(Snapshot& snapshot,
                                                       std::string_view robot_name,
                                                       const PageRequest& request,
                                                       const ListFilter<v1::Calibration>& filter) {
  TRUEPOSE_RETURN_IF_ERROR(AtField(GetRobot(snapshot, robot_name).status(), "robot"));
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string robot_id, ParseRobotName(robot_name, "robot"));
  const ListId id{"calibrations", absl::StrCat(robot_id, "|", filter.Key())};
  TRUEPOSE_ASSIGN_OR_RETURN(const PageStart start, CheckPage(id, request));
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t before,
                            AfterNumber(start, std::numeric_limits<int64_t>::max()));
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto rows,
      sql::Query(snapshot.sql(),
                 "SELECT number, message FROM calibrations WHERE robot_id = $1 AND number < $2 "
                 "ORDER BY number DESC",
                 robot_id, before));
  return ReadFilteredPage<v1::Calibration>(
      id, start.size, *rows, filter,
      [&](const sql::Statement& row) -> absl::StatusOr<v1::Calibration> {
        TRUEPOSE_ASSIGN_OR_RETURN(auto calibration, ReadMessage<v1::Calibration>(row, 1));
        TRUEPOSE_RETURN_IF_ERROR(FillRelease(snapshot, calibration));
        return calibration;
      });
}

}  // namespace truepose::store
