// The way of a calibration to its robot: appended steps, the last of which is its state. Who may do
// what is decided above (server/services/release.h).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "server/store/transaction.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::store {

// Appends a step at the transaction's time and records the event. @returns the calibration as it is
// then, without residuals and covariance; kNotFound.
absl::StatusOr<v1::Calibration> AppendReleaseStep(Transaction& transaction, std::string_view name,
                                                  v1::ReleaseState state,
                                                  const std::string& principal,
                                                  const std::string& reason);

// Sets state, release_steps, revision and etag of a calibration that was read; DRAFT without a
// step.
absl::Status FillRelease(Snapshot& snapshot, v1::Calibration& calibration);

// When the calibration became active for the last time; nothing when it never did.
absl::StatusOr<std::optional<absl::Time>> ActivationTime(Snapshot& snapshot, std::string_view name);

// The calibration that was active on the robot before `active` became so; nothing when there was
// none.
absl::StatusOr<std::optional<std::string>> PreviouslyActive(Snapshot& snapshot,
                                                            const std::string& robot_id,
                                                            std::string_view active);

}  // namespace truepose::store
