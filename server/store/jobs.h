// Calibration jobs and their frozen input. Which state may follow which is decided above
// (server/jobs/job_state.h).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "server/store/page.h"
#include "server/store/transaction.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::store {

// Stores a PENDING job and freezes its input in the same transaction: nominal revision, session
// names with their digests, options and input digest. Of `job` are used: robot, sessions, options,
// nominal_revision, input_digest. A repeat with the same robot and input digest returns the job as
// it is now; wake the engine after the commit.
// @returns kInvalidArgument for names or no session; kNotFound for the robot, revision or a
// session; all faults at once with
//   kFailedPrecondition for sessions that are not sealed or of another robot; kAlreadyExists for a
//   job of other input.
absl::StatusOr<v1::CalibrationJob> CreateJob(Transaction& transaction, std::string_view job_id,
                                             const v1::CalibrationJob& job);
absl::StatusOr<v1::CalibrationJob> GetJob(Snapshot& snapshot, std::string_view name);
// Newest first; `robot` = "" lists those of all robots.
absl::StatusOr<Page<v1::CalibrationJob>> ListJobs(Snapshot& snapshot, std::string_view robot,
                                                  const PageRequest& request);

// All that the job needs to run, as frozen at its creation.
// @returns kDataLoss when a session isn't what was frozen.
absl::StatusOr<v1::CalibrationInput> LoadJobInput(Snapshot& snapshot,
                                                  const v1::CalibrationJob& job);

// A worker's right to end a job: the revision at which it was claimed; 0 = nobody's.
using Lease = int64_t;

// Writes the job's state, its revision and its lease. @returns kNotFound.
absl::Status UpdateJob(Transaction& transaction, v1::CalibrationJob& job, Lease lease);
absl::StatusOr<Lease> GetLease(Snapshot& snapshot, std::string_view name);
// Names in the order of creation.
absl::StatusOr<std::vector<std::string>> JobsInState(Snapshot& snapshot, v1::JobState state);
absl::StatusOr<std::optional<std::string>> OldestInState(Snapshot& snapshot, v1::JobState state);

}  // namespace truepose::store
