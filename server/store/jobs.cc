#include "server/store/jobs.h"

#include <limits>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/store/events.h"
#include "server/store/frozen_input.h"
#include "server/store/keys.h"
#include "server/store/list.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/sql/query.h"

namespace truepose::store {
namespace {

constexpr Lease kNobody = 0;

// Microseconds since 1970 as the queue orders them; 0 = none.
int64_t DeadlineKey(const v1::CalibrationJob& job) {
  return job.has_deadline() ? absl::ToUnixMicros(DeadlineOf(job)) : 0;
}

// A retry of the request that made `stored`.
bool IsRepeat(const v1::CalibrationJob& stored, const v1::CalibrationJob& asked) {
  return stored.robot() == asked.robot() && stored.input_digest() == asked.input_digest() &&
         stored.priority() == asked.priority() && DeadlineKey(stored) == DeadlineKey(asked) &&
         stored.recalibration_request() == asked.recalibration_request() &&
         stored.compensation_table() == asked.compensation_table();
}

// The job of this id, if the request is a repeat of the one that made it.
absl::StatusOr<std::optional<v1::CalibrationJob>> FindRepeat(Snapshot& snapshot,
                                                             std::string_view job_id,
                                                             const v1::CalibrationJob& asked) {
  TRUEPOSE_RETURN_IF_ERROR(CheckUuid(job_id, "job_id"));
  absl::StatusOr<v1::CalibrationJob> stored = GetJob(snapshot, JobName(job_id));
  if (absl::IsNotFound(stored.status())) return std::nullopt;
  if (!stored.ok()) return stored.status();
  if (IsRepeat(*stored, asked)) return std::optional(*std::move(stored));
  return Refusal(absl::StatusCode::kAlreadyExists, "job_id",
                 absl::StrCat(stored->name(), " with other input"), "a new UUID");
}

// The order is the client's, the rest is as every job begins.
v1::CalibrationJob NewJob(const std::string& id, const v1::CalibrationJob& asked, absl::Time now) {
  v1::CalibrationJob job;
  job.set_name(JobName(id));
  job.set_robot(asked.robot());
  *job.mutable_sessions() = asked.sessions();
  *job.mutable_options() = asked.options();
  job.set_nominal_revision(asked.nominal_revision());
  job.set_input_digest(asked.input_digest());
  job.set_state(v1::PENDING);
  job.set_priority(asked.priority());
  if (asked.has_deadline()) *job.mutable_deadline() = ToTimestamp(DeadlineOf(asked));
  job.set_created_by(asked.created_by());
  job.set_created_by_machine(asked.created_by_machine());
  job.set_recalibration_request(asked.recalibration_request());
  job.set_compensation_table(asked.compensation_table());
  *job.mutable_create_time() = ToTimestamp(now);
  return job;
}

absl::Status InsertJob(Transaction& transaction, const std::string& id,
                       const v1::CalibrationJob& asked) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::vector<FrozenSession> sessions,
                            CheckJobInput(transaction, asked));
  TRUEPOSE_RETURN_IF_ERROR(CheckDeadline(asked, transaction.now()));
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string robot_id, ParseRobotName(asked.robot(), "robot"));
  v1::CalibrationJob job = NewJob(id, asked, transaction.now());
  TRUEPOSE_ASSIGN_OR_RETURN(
      const Key key,
      sql::QueryInt64(
          transaction.sql(),
          "INSERT INTO jobs (sequence, id, robot_id, state, priority, deadline, message) VALUES "
          "((SELECT COALESCE(MAX(sequence), 0) + 1 FROM jobs), $1, $2, $3, $4, $5, $6) "
          "RETURNING sequence",
          id, robot_id, static_cast<int>(v1::PENDING), job.priority(), DeadlineKey(job),
          sql::BlobView{}));
  TRUEPOSE_RETURN_IF_ERROR(FreezeSessions(transaction, key, sessions));
  return UpdateJob(transaction, job, kNobody);
}

absl::StatusOr<std::vector<std::string>> NamesOf(sql::Statement& rows) {
  std::vector<std::string> names;
  for (;;) {
    TRUEPOSE_ASSIGN_OR_RETURN(const bool found, rows.Step());
    if (!found) return names;
    names.push_back(JobName(rows.Text(0)));
  }
}

}  // namespace

absl::StatusOr<v1::CalibrationJob> CreateJob(Transaction& transaction, std::string_view job_id,
                                             const v1::CalibrationJob& job) {
  TRUEPOSE_ASSIGN_OR_RETURN(std::optional<v1::CalibrationJob> stored,
                            FindRepeat(transaction, job_id, job));
  if (stored.has_value()) return *std::move(stored);
  const std::string id(job_id);
  TRUEPOSE_RETURN_IF_ERROR(InsertJob(transaction, id, job));
  return GetJob(transaction, JobName(id));
}

absl::StatusOr<v1::CalibrationInput> PreviewJobInput(Snapshot& snapshot, std::string_view job_id,
                                                     const v1::CalibrationJob& job) {
  TRUEPOSE_RETURN_IF_ERROR(FindRepeat(snapshot, job_id, job).status());
  TRUEPOSE_RETURN_IF_ERROR(CheckJobInput(snapshot, job).status());
  return LoadInputNow(snapshot, job);
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
                                                  const PageRequest& request,
                                                  const ListFilter<v1::CalibrationJob>& filter) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string robot_id, RobotFilter(snapshot, robot));
  const ListId id{"jobs", absl::StrCat(robot_id, "|", filter.Key())};
  TRUEPOSE_ASSIGN_OR_RETURN(const PageStart start, CheckPage(id, request));
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t before,
                            AfterNumber(start, std::numeric_limits<int64_t>::max()));
  const char* sql =
      robot_id.empty() ? "SELECT sequence, message FROM jobs WHERE $1 = '' AND sequence < $2 "
                         "ORDER BY sequence DESC"
                       : "SELECT sequence, message FROM jobs WHERE robot_id = $1 AND sequence < $2 "
                         "ORDER BY sequence DESC";
  TRUEPOSE_ASSIGN_OR_RETURN(auto rows, sql::Query(snapshot.sql(), sql, robot_id, before));
  return ReadFilteredPage<v1::CalibrationJob>(
      id, start.size, *rows, filter,
      [](const sql::Statement& row) { return ReadMessage<v1::CalibrationJob>(row, 1); });
}

absl::Status UpdateJob(Transaction& transaction, v1::CalibrationJob& job, Lease lease) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Key key, JobKey(transaction, job.name()));
  job.set_revision(transaction.revision());
  job.set_etag(ToEtag(job.revision()));
  TRUEPOSE_RETURN_IF_ERROR(sql::Run(
      transaction.sql(), "UPDATE jobs SET state = $2, lease = $3, message = $4 WHERE sequence = $1",
      key, static_cast<int>(job.state()), lease, sql::BlobView{ToBlob(job)}));
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string robot_id, ParseRobotName(job.robot(), "robot"));
  return RecordEvent(
      transaction,
      {.kind = v1::KIND_JOB, .robot_id = robot_id, .name = job.name(), .deleted = false}, job);
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
  return NamesOf(*rows);
}

absl::StatusOr<std::optional<std::string>> NextJob(Snapshot& snapshot, absl::Time now) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto row,
      sql::Query(snapshot.sql(),
                 "SELECT id FROM jobs WHERE state = $1 AND robot_id NOT IN "
                 "(SELECT robot_id FROM jobs WHERE state = $2) AND (deadline = 0 OR deadline > $3) "
                 "ORDER BY priority DESC, sequence LIMIT 1",
                 static_cast<int>(v1::PENDING), static_cast<int>(v1::RUNNING),
                 absl::ToUnixMicros(now)));
  TRUEPOSE_ASSIGN_OR_RETURN(const bool found, row->Step());
  if (!found) return std::optional<std::string>();
  return std::optional<std::string>(JobName(row->Text(0)));
}

absl::StatusOr<std::vector<std::string>> LatePendingJobs(Snapshot& snapshot, absl::Time now,
                                                         int limit) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto rows,
      sql::Query(snapshot.sql(),
                 "SELECT id FROM jobs WHERE state = $1 AND deadline > 0 AND deadline <= $2 "
                 "ORDER BY deadline LIMIT $3",
                 static_cast<int>(v1::PENDING), absl::ToUnixMicros(now), limit));
  return NamesOf(*rows);
}

absl::Time DeadlineOf(const v1::CalibrationJob& job) {
  if (!job.has_deadline()) return absl::InfiniteFuture();
  return absl::FromUnixMicros(absl::ToUnixMicros(ToTime(job.deadline())));
}

}  // namespace truepose::store
