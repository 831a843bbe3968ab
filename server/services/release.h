// Release: draft -> approved | rejected -> active -> superseded. One active calibration a robot.
//
// Who may approve, by the robot's policy (TWO_PERSON unless it says otherwise): a person, never a
// machine. TWO_PERSON: who neither created the job nor sealed one of its sessions; a job that a
// machine made needs one person. ONE_PERSON: any person. On a server that is open to everybody
// (local-dev) there is one person only, and TWO_PERSON counts as ONE_PERSON. A calibration whose
// verdict is do_not_apply is approved with a reason only. An activation of a robot with a
// table_spec queues the compensation table in the same commit (table_jobs.h).
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "server/services/call_context.h"
#include "truepose/v1/services.pb.h"

namespace truepose::services {

// Each returns the calibration in its new state, without residuals and covariance.
// @returns kNotFound; kPermissionDenied with who may; kFailedPrecondition for a state from which
// that step doesn't lead, a verdict without reason, a nominal that is no longer the robot's latest;
// kAborted for the etag.
absl::StatusOr<v1::Calibration> ApproveCalibration(const CallContext& call,
                                                   const v1::ApproveCalibrationRequest& request);
absl::StatusOr<v1::Calibration> RejectCalibration(const CallContext& call,
                                                  const v1::RejectCalibrationRequest& request);
absl::StatusOr<v1::Calibration> ActivateCalibration(const CallContext& call,
                                                    const v1::ActivateCalibrationRequest& request);
absl::StatusOr<v1::Calibration> RollBackCalibration(const CallContext& call,
                                                    const v1::RollBackCalibrationRequest& request);

// After a job: approves and activates its calibration when the robot's policy is
// AUTOMATIC_WITHIN_LIMITS and the result is within the robot's limits, as principal "server".
// Within the job's own transaction. Otherwise it stays a draft, and nothing is written.
absl::Status ReleaseWithinLimits(store::Transaction& transaction,
                                 const v1::Calibration& calibration);

}  // namespace truepose::services
