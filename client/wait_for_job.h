// A calibration job becomes one wait, however often the connection breaks.
#pragma once

#include <chrono>
#include <functional>
#include <string>

#include "absl/status/statusor.h"
#include "client/client.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::client {

struct WaitOptions {
  // In this thread, at the first look and after each change of state or progress.
  std::function<void(const v1::CalibrationJob&)> on_change = {};
  // Asked a few times a second; true ends the wait with kCancelled and leaves the job running.
  std::function<bool()> is_cancelled = {};
  // How long a server may stay away before the wait is given up. Counted anew from each answer.
  std::chrono::milliseconds patience{60'000};
  std::chrono::milliseconds poll_interval{500};  // between looks while watching is not possible
};

// Waits until the job SUCCEEDED, FAILED or was CANCELLED: watches, connects again when the stream
// breaks, and asks with GetCalibrationJob where streams do not pass.
// @returns the job in its terminal state, whichever it is; kNotFound; kCancelled by is_cancelled =
// {}; kUnavailable
//   when no server answered for `patience`. The job itself is never touched.
absl::StatusOr<v1::CalibrationJob> WaitForJob(const Client& client, const std::string& name,
                                              const WaitOptions& options = {});

bool IsTerminal(v1::JobState state);

}  // namespace truepose::client
