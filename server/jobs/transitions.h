// What happens to a job in the store: one function for each change, each within one transaction of
// the caller.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/store/compensation_tables.h"
#include "server/store/jobs.h"
#include "server/store/transaction.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::jobs {

// A job that a worker runs, and its right to end it.
struct Claim {
  v1::CalibrationJob job;
  store::Lease lease = 0;
};

// How a run ended.
struct Outcome {
  enum class Kind {
    kResult,     // `table`, or else `calibration`, is stored and the job SUCCEEDED
    kError,      // the job FAILED with `error`
    kCancelled,  // the job is CANCELLED
    kStopped,    // the engine stops: the job is PENDING again, the attempt not counted
  };
  Kind kind = Kind::kError;
  v1::Calibration calibration = {};
  std::optional<store::TableFile> table = {};
  absl::Status error = {};
};

// An error as jobs and tables show it, with its faults.
v1::JobError ToJobError(const absl::Status& error);

// PENDING -> RUNNING of the one whose turn it is (store::NextJob); nothing when none may run.
absl::StatusOr<std::optional<Claim>> ClaimNext(store::Transaction& transaction);

// RUNNING -> what the outcome says; CANCELLED when that was asked for before; FAILED instead of
// SUCCEEDED when the job's deadline has passed. A result whose content the robot has already is not
// stored again (store::InsertCalibration), the job is SUCCEEDED with the one there is.
// @returns false, and changes nothing, when the claim's lease is lost.
absl::StatusOr<bool> EndJob(store::Transaction& transaction, const Claim& claim,
                            const Outcome& outcome);

// See JobEngine::Cancel.
absl::StatusOr<v1::CalibrationJob> RequestCancel(store::Transaction& transaction,
                                                 std::string_view name);

// Ends the claim's lease without its worker, for the reason given: RUNNING becomes CANCELLED when
// that was asked for, FAILED when its deadline has passed or the job was begun `max_attempts`
// times, PENDING otherwise. @returns false, and changes nothing, when the lease is lost already.
absl::StatusOr<bool> TakeBack(store::Transaction& transaction, const Claim& claim, int max_attempts,
                              std::string_view reason);

// PENDING -> FAILED of jobs whose deadline has passed, a hundred at once at most. @returns their
// names.
absl::StatusOr<std::vector<std::string>> FailLate(store::Transaction& transaction);

// Ends every lease as TakeBack does. For the start of a process, when nobody can be running them.
// @returns their names.
absl::StatusOr<std::vector<std::string>> RecoverRunning(store::Transaction& transaction,
                                                        int max_attempts);

}  // namespace truepose::jobs
