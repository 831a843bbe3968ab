// The way of a recalibration request, as plain checks.
//
//   PENDING -> ACKNOWLEDGED -> MEASURING -> CALIBRATING -> DONE
//   any of the first four -> DECLINED | EXPIRED
//   MEASURING -> MEASURING     more readings, or another session
//   CALIBRATING -> DONE        by the job, in the commit that makes it SUCCEEDED
//   CALIBRATING -> MEASURING   by the job that FAILED or was CANCELLED, with the reason
//
// The last three states never change again.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "truepose/v1/recalibration.pb.h"

namespace truepose::services {

// Somebody still has to do something.
bool IsOpen(v1::RecalibrationState state);

// Whether a caller may bring the request to `to`. Only jobs lead away from CALIBRATING, but for
// declined and expired.
// @returns kFailedPrecondition that names the state found, the states from which `to` may follow,
// and what is possible from the one found.
absl::Status CheckStep(const v1::RecalibrationRequest& request, v1::RecalibrationState to);

}  // namespace truepose::services
