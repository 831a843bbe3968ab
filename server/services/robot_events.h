// CreateRobotEvent: what happened to a robot, and whether that calls for a recalibration.
#pragma once

#include "absl/status/statusor.h"
#include "server/services/call_context.h"
#include "truepose/v1/recalibration_services.pb.h"

namespace truepose::services {

// Stores the event. One that is a cause (recalibration_causes.h) raises a request in the same
// commit, or is noted in the one that is open. A repeat with the same content gives the stored
// event and raises nothing.
// @returns the errors of CreateStandard (standard.h).
absl::StatusOr<v1::RobotEvent> CreateRobotEvent(const CallContext& call,
                                                const v1::CreateRobotEventRequest& request);

}  // namespace truepose::services
