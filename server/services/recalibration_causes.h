// What makes the server ask for a recalibration: whether an event, a drift check or the time that
// has passed is a cause, and the request that it would raise. Reads only; the caller raises
// (recalibration_requests.h) in the transaction in which this was asked.
//
// A robot without an active calibration has nothing that could have become wrong: no cause.
#pragma once

#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "server/services/recalibration_requests.h"
#include "server/store/transaction.h"
#include "truepose/v1/recalibration.pb.h"

namespace truepose::services {

// The event's kind is named by a policy of the robot and it happened after the active calibration's
// sessions were sealed; or its temperature is at least temperature_step_k from their mean
// temperature_c, and from that of each event that has raised a request since the activation. With
// no temperature in the sessions there is nothing to compare with.
absl::StatusOr<std::optional<NewRequest>> CauseOfEvent(store::Snapshot& snapshot,
                                                       const std::string& robot,
                                                       const v1::RobotEvent& event, absl::Time now);

// The check is beyond the robot's limit, and the robot has no policy or one with on_failed_check.
absl::StatusOr<std::optional<NewRequest>> CauseOfCheck(store::Snapshot& snapshot,
                                                       const std::string& robot,
                                                       const v1::DriftCheck& check);

// Another interval of the policy is over since the activation, and no request of the robot has been
// open since its end: that one was of its time, whatever raised it and however it ended.
absl::StatusOr<std::optional<NewRequest>> CauseOfInterval(store::Snapshot& snapshot,
                                                          const v1::RecalibrationPolicy& policy,
                                                          absl::Time now);

}  // namespace truepose::services
