// Calibration jobs and their frozen input. Which state may follow which is decided above
// (server/jobs/job_state.h).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "server/store/list.h"
#include "server/store/page.h"
#include "server/store/transaction.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::store {

inline constexpr int kLowestPriority = -100, kHighestPriority = 100;

// Stores a PENDING job and freezes its input in the same transaction: nominal revision, session
// names with their digests, options and input digest. Of `job` are used: robot, sessions, options,
// nominal_revision, input_digest, priority, deadline (to the microsecond), created_by,
// created_by_machine, recalibration_request, and compensation_table: a job that builds a table has
// no sessions, its input is read by LoadTableInput (compensation_tables.h). A repeat with the same
// robot, input digest, priority, deadline, recalibration request and table returns the job as it is
// now, whoever repeats it; wake the engine after the commit.
// @returns kInvalidArgument for names, no session, a priority out of range or a deadline that isn't
// a time; kNotFound for the robot, revision or a session; all faults at once with
//   kFailedPrecondition for sessions that are not sealed or of another robot, and for a deadline
//   that has passed; kAlreadyExists for a job of other content.
absl::StatusOr<v1::CalibrationJob> CreateJob(Transaction& transaction, std::string_view job_id,
                                             const v1::CalibrationJob& job);
absl::StatusOr<v1::CalibrationJob> GetJob(Snapshot& snapshot, std::string_view name);
// Newest first; `robot` = "" lists those of all robots.
absl::StatusOr<Page<v1::CalibrationJob>> ListJobs(
    Snapshot& snapshot, std::string_view robot, const PageRequest& request,
    const ListFilter<v1::CalibrationJob>& filter = {});

// All that the job needs to run, as frozen at its creation.
// @returns kDataLoss when a session isn't what was frozen.
absl::StatusOr<v1::CalibrationInput> LoadJobInput(Snapshot& snapshot,
                                                  const v1::CalibrationJob& job);

// What a job would read if CreateJob stored it now; nothing is stored. @returns CreateJob's faults.
absl::StatusOr<v1::CalibrationInput> PreviewJobInput(Snapshot& snapshot, std::string_view job_id,
                                                     const v1::CalibrationJob& job);

// A worker's right to end a job: the revision at which it was claimed; 0 = nobody's.
using Lease = int64_t;

// Writes the job's state, its revision, its etag and its lease. Priority and deadline stay as they
// were created. @returns kNotFound.
absl::Status UpdateJob(Transaction& transaction, v1::CalibrationJob& job, Lease lease);
absl::StatusOr<Lease> GetLease(Snapshot& snapshot, std::string_view name);
// Names in the order of creation.
absl::StatusOr<std::vector<std::string>> JobsInState(Snapshot& snapshot, v1::JobState state);
// The PENDING job whose turn it is: of the robots without a RUNNING job, the one with the highest
// priority, of equal ones the one that was created first. Passes over jobs whose deadline is `now`
// or earlier.
absl::StatusOr<std::optional<std::string>> NextJob(Snapshot& snapshot, absl::Time now);

// PENDING jobs whose deadline is `now` or earlier, at most `limit`, the earliest deadline first.
absl::StatusOr<std::vector<std::string>> LatePendingJobs(Snapshot& snapshot, absl::Time now,
                                                         int limit);
// absl::InfiniteFuture() for a job without one.
absl::Time DeadlineOf(const v1::CalibrationJob& job);

}  // namespace truepose::store
