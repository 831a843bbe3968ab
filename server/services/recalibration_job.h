// The job that answers a recalibration request: how it is made, and what its end does to the
// request. Each within a transaction of the caller.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "server/store/transaction.h"
#include "truepose/v1/recalibration.pb.h"
#include "truepose/v1/services.pb.h"

namespace truepose::services {

// A request has some 20 poses: a half of them, as of a long session, would identify too little; a
// quarter are the 5 that an interval of the improvement needs at least.
inline constexpr char kSplitOfRequest[] = "random:1:0.75";

// The job over the request's session, with the options of the robot's active calibration, so that
// both can be compared, but for what belongs to its data: the split is
// `split`, "" = kSplitOfRequest; a group column that the session lacks is dropped. `calibrate` is
// the request's; when that isn't all, the active calibration is the prior. Without an active one
// the options are the default ones.
// @returns kInvalidArgument with faults of the options.
absl::StatusOr<v1::CreateCalibrationJobRequest> JobFor(store::Snapshot& snapshot,
                                                       const v1::RecalibrationRequest& request,
                                                       const std::string& split);

// Binds a job that was created to the request that it names: MEASURING -> CALIBRATING. A job
// without one, one that has ended and one that is bound already change nothing. @returns the
// request.
// @returns kInvalidArgument for the name, or a request of another robot; kNotFound;
// kFailedPrecondition for its state. Faults of `recalibration_request`, but of `name` for the
// state.
absl::Status BeginCalibrating(store::Transaction& transaction, const v1::CalibrationJob& job,
                              const std::string& principal);

// Of a job that has ended (jobs::EngineOptions::on_end): its request becomes DONE with the
// calibration, or MEASURING again with the reason. A request that has ended meanwhile, or waits for
// another job, stays as it is; the job is not undone by that.
absl::Status MoveRequestOfJob(store::Transaction& transaction, const v1::CalibrationJob& job);

}  // namespace truepose::services
