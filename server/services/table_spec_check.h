// Whether a robot's table_spec can be built, found out when it is set: else only the job that
// follows the next activation would tell.
#pragma once

#include "absl/status/status.h"
#include "server/services/call_context.h"
#include "truepose/v1/robot.pb.h"
#include "truepose/v1/services.pb.h"

namespace truepose::services {

// By the nominal chain (convert/table_domain.h); where a calibration is active also the estimate of
// the table that would be built of it, with its size. Computes for some 0.1 s: not to be
// called within a closure of the store.
// @param robot as it will be, with its nominal revision.
// @returns kInvalidArgument with every fault below `robot.table_spec.`; OK without a spec, and for
//   what is no fault of the spec.
absl::Status CheckSpecBuildable(const CallContext& call, const v1::Robot& robot);

// The same for the robot that the request would leave; OK when the request is a repeat or the spec
// stays the same, and for what only writing it finds.
absl::Status CheckSpecBuildable(const CallContext& call, const v1::UpdateRobotRequest& request);

bool HasSameSpec(const v1::Robot& before, const v1::Robot& after);

}  // namespace truepose::services
