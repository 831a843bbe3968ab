// CreateDriftCheck: a sealed session against the robot's active calibration (docs/drift.md).
#pragma once

#include "absl/status/statusor.h"
#include "server/services/call_context.h"
#include "truepose/v1/recalibration_services.pb.h"

namespace truepose::services {

// Of `drift_check` only `session` is read, and `calibration`, which is the active one or "". The
// check is computed beside the store (convert/drift.h) and stored; one that is a cause
// (recalibration_causes.h) raises a request in the same commit, or is noted in the one that is
// open. A repeat with the same id and session gives what is stored and computes nothing.
// @returns kInvalidArgument with every fault of the request, and of the session's readings;
// kNotFound; kFailedPrecondition with every fault of session and calibration: not sealed, of
// another robot, not active, too few readings; kAlreadyExists for an id with another session;
// kAborted when another calibration became active meanwhile.
absl::StatusOr<v1::DriftCheck> CreateDriftCheck(const CallContext& call,
                                                const v1::CreateDriftCheckRequest& request);

}  // namespace truepose::services
