// The states of a job and which may follow which:
//
//   PENDING -> RUNNING      a worker claims it
//   PENDING -> CANCELLED    cancelled before it ran
//   PENDING -> FAILED       its deadline passed before it ran
//   RUNNING -> SUCCEEDED    in the same commit as its calibration
//   RUNNING -> FAILED       the run failed, took too long or beyond its deadline, or was begun too
//                           often
//   RUNNING -> CANCELLED    cancelled while it ran
//   RUNNING -> PENDING      the lease is lost: the process ended or stopped, or the worker gave no
//                           sign of life
//
// A state is visible after its commit, never before.
#pragma once

#include "absl/status/status.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::jobs {

// SUCCEEDED, FAILED and CANCELLED never change again.
bool IsTerminal(v1::JobState state);

// @returns kFailedPrecondition that names both states when `to` may not follow `from`.
absl::Status CheckTransition(v1::JobState from, v1::JobState to);

}  // namespace truepose::jobs
