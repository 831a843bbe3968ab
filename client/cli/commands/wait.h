// Waiting for a job on a server, as `calibrate` and `job watch` do.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/cli/command_line.h"
#include "client/cli/interrupt.h"
#include "client/client.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::cli {

// Shows the progress on a terminal until the job has ended, in whatever way.
// @returns kCancelled after Ctrl-C and kUnavailable when the server stays away; the job is left
// running then, and the
//   message says how to watch it.
// @param label of the bar.
// @param interrupt begun before the job was created, so that no Ctrl-C falls between the two.
absl::StatusOr<v1::CalibrationJob> WaitWithProgress(const Invocation& invocation,
                                                    const client::Client& client,
                                                    const std::string& job,
                                                    const InterruptScope& interrupt,
                                                    const std::string& label = "calibrate");

// What an ended job means: OK, kCancelled, or the job's error with its faults.
absl::Status StatusOfJob(const v1::CalibrationJob& job);

}  // namespace truepose::cli
