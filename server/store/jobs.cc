#include "server/store/jobs.h"

#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/store/frozen_input.h"
#include "server/store/keys.h"
#include "server/store/list.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/sql/query.h"

namespace truepose::store {
namespace {

constexpr Lease kNobody = 0;

absl::Status InsertJob(Transaction& transaction, const std::string& id,
                       const v1::CalibrationJob& asked) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::vector<FrozenSession> sessions,
                            CheckJobInput(transaction, asked));
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string robot_id, ParseRobotName(asked.robot(), "robot"));
  v1::CalibrationJob job;
  job.set_name(JobName(id));
  job.set_robot(asked.robot());
  *job.mutable_sessions() = asked.sessions();
  *job.mutable_options() = asked.options();
  job.set_nominal_revision(asked.nominal_revision());
  job.set_input_digest(asked.input_digest());
  job.set_state(v1::PENDING);
  *job.mutable_create_time() = ToTimestamp(transaction.now());
  TRUEPOSE_ASSIGN_OR_RETURN(
      const Key key,
      sql::QueryInt64(transaction.sql(),
                      "INSERT INTO jobs (sequence, id, robot_id, state, message) VALUES "
                      "((SELECT COALESCE(MAX(sequence), 0) + 1 FROM jobs), $1, $2, $3, $4) "
                      "RETURNING sequence",
                      id, robot_id, static_cast<int>(v1::PENDING), sql::BlobView{}));
  TRUEPOSE_RETURN_IF_ERROR(FreezeSessions(transaction, key, sessions));
  return UpdateJob(transaction, job, kNobody);
}

}  // namespace

absl::StatusOr<v1::CalibrationJob> CreateJob(Transaction& transaction, std::string_view job_id,
                                             const v1::CalibrationJob& job) {
  TRUEPOSE_RETURN_IF_ERROR(CheckUuid(job_id, "job_id"));
  const std::string id(job_id);
  absl::StatusOr<v1::CalibrationJob> stored = GetJob(transaction, JobName(id));
  if (stored.ok() && stored->robot() == job.robot() && stored->input_digest() == job.input_digest())
    return stored;
  if (stored.ok()) {
    return Refusal(absl::StatusCode::kAlreadyExists, "job_id",
                   absl::StrCat(stored->name(), " with other input"), "a new UUID");
  }
  if (!absl::IsNotFound(stored.status())) return stored.status();
  TRUEPOSE_RETURN_IF_ERROR(InsertJob(transaction, id, job));
  return GetJob(transaction, JobName(id));
}

absl::StatusOr<v1::CalibrationJob> GetJob(Snapshot& snapshot, std::string_view name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Key key, JobKey(snapshot, name));
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto row, sql::Query(snapshot.sql(), "SELECT message FROM jobs WHERE sequence = $1", key));
  TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
  if (!found) return NotFound(name);
  return ReadMessage<v1::CalibrationJob>(*row, 0);
}

absl::StatusOr<Page<v1::CalibrationJob>> ListJobs(Snapshot& snapshot, std::string_view robot,
                                                  const PageRequest& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string robot_id, RobotFilter(snapshot, robot));
  const ListId id{"jobs", robot_id};
  TRUEPOSE_ASSIGN_OR_RETURN(const PageStart start, CheckPage(id, request));
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t before,
                            AfterNumber(start, std::numeric_limits<int64_t>::max()));
  const char* sql =
      robot_id.empty() ? "SELECT sequence, message FROM jobs WHERE $1 = '' AND sequence < $2 "
                         "ORDER BY sequence DESC LIMIT $3"
                       : "SELECT sequence, message FROM jobs WHERE robot_id = $1 AND sequence < $2 "
                         "ORDER BY sequence DESC LIMIT $3";
  TRUEPOSE_ASSIGN_OR_RETURN(auto rows,
                            sql::Query(snapshot.sql(), sql, robot_id, before, start.size + 1));
  return ReadPage<v1::CalibrationJob>(id, start.size, *rows, [](const sql::Statement& row) {
    return ReadMessage<v1::CalibrationJob>(row, 1);
  });
}

absl::Status UpdateJob(Transaction& transaction, v1::CalibrationJob& job, Lease lease) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Key key, JobKey(transaction, job.name()));
  job.set_revision(transaction.revision());
  return sql::Run(transaction.sql(),
                  "UPDATE jobs SET state = $2, lease = $3, message = $4 WHERE sequence = $1", key,
                  static_cast<int>(job.state()), lease, sql::BlobView{ToBlob(job)});
}

absl::StatusOr<Lease> GetLease(Snapshot& snapshot, std::string_view name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Key key, JobKey(snapshot, name));
  return sql::QueryInt64(snapshot.sql(), "SELECT lease FROM jobs WHERE sequence = $1", key);
}

absl::StatusOr<std::vector<std::string>> JobsInState(Snapshot& snapshot, v1::JobState state) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto rows,
      sql::Query(snapshot.sql(), "SELECT id FROM jobs WHERE state = $1 ORDER BY sequence",
                 static_cast<int>(state)));
  std::vector<std::string> names;
  for (;;) {
    TRUEPOSE_ASSIGN_OR_RETURN(const bool found, rows->Step());
    if (!found) return names;
    names.push_back(JobName(rows->Text(0)));
  }
}

absl::StatusOr<std::optional<std::string>> OldestInState(Snapshot& snapshot, v1::JobState state) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto row,
      sql::Query(snapshot.sql(), "SELECT id FROM jobs WHERE state = $1 ORDER BY sequence LIMIT 1",
                 static_cast<int>(state)));
  TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
  if (!found) return std::optional<std::string>();
  return std::optional<std::string>(JobName(row->Text(0)));
}

}  // namespace truepose::store
