// Handlers of CalibrationService that are about jobs (proto/truepose/v1/services.proto).
// @returns kInvalidArgument with every fault of the request and its field path; kNotFound for a
// name that is well
//   formed and unknown; what store and engine say else. Nothing is stored on failure.
#pragma once

#include <memory>

#include "absl/status/statusor.h"
#include "server/jobs/watch.h"
#include "server/services/call_context.h"
#include "truepose/v1/services.pb.h"

namespace truepose::services {

// The job as it is to be stored: what was asked for, and what that means today. The errors are
// those of CreateCalibrationJob.
absl::StatusOr<v1::CalibrationJob> FreezeInput(store::Snapshot& snapshot,
                                               const v1::CreateCalibrationJobRequest& request);

// Freezes the input, stores the job and wakes a worker. The job uses the nominal revision of its
// sessions. With validate_only nothing is stored and nothing runs: the answer is the job without a
// state, with `preview` (convert::RunPreview), or the error that a create or the begin of the run
// would have; a deadline is not looked at, since time goes on.
// @returns kFailedPrecondition with a fault for each session that is not sealed, is of another
// robot, or was begun
//   under another nominal revision than the first; and with a `recalibration_request`, which the
//   job answers, when that isn't MEASURING (recalibration_job.h).
absl::StatusOr<v1::CalibrationJob> CreateCalibrationJob(
    const CallContext& call, const v1::CreateCalibrationJobRequest& request);
absl::StatusOr<v1::CalibrationJob> GetCalibrationJob(const CallContext& call,
                                                     const v1::GetCalibrationJobRequest& request);
absl::StatusOr<v1::ListCalibrationJobsResponse> ListCalibrationJobs(
    const CallContext& call, const v1::ListCalibrationJobsRequest& request);
absl::StatusOr<v1::CalibrationJob> CancelCalibrationJob(
    const CallContext& call, const v1::CancelCalibrationJobRequest& request);
absl::StatusOr<std::unique_ptr<jobs::Subscription>> WatchCalibrationJob(
    const CallContext& call, const v1::WatchCalibrationJobRequest& request,
    jobs::WatchCallbacks callbacks);

}  // namespace truepose::services
