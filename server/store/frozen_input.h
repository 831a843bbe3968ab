// What a job will read, fixed when it is created. Only for .cc files of this folder.
#pragma once

#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "server/store/keys.h"
#include "server/store/transaction.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::store {

struct FrozenSession {
  Key session = 0;
  std::string digest;
};

// Every session of the job, in its order.
// @returns the faults that store::CreateJob names, all of them at once.
absl::StatusOr<std::vector<FrozenSession>> CheckJobInput(Snapshot& snapshot,
                                                         const v1::CalibrationJob& job);

// kFailedPrecondition with a fault of `deadline` when it is `now` or earlier.
absl::Status CheckDeadline(const v1::CalibrationJob& job, absl::Time now);

// Nominal, options and sessions with their readings as they are now.
absl::StatusOr<v1::CalibrationInput> LoadInputNow(Snapshot& snapshot,
                                                  const v1::CalibrationJob& job);

absl::Status FreezeSessions(Transaction& transaction, Key job,
                            const std::vector<FrozenSession>& sessions);

}  // namespace truepose::store
