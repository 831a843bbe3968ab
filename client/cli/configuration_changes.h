// Where a path of poses can't be followed in one configuration of the arm.
#pragma once

#include "client/cli/console.h"
#include "truepose/v1/robot.pb.h"
#include "truepose/v1/services.pb.h"

namespace truepose::cli {

// One warning on console.err when between two near targets in a row (0.25 m, 45 deg), the second a
// pose without joints of its own, a turning joint turns by more than 90 deg: how often, and of the
// first the row, joint and angle.
// @param response with a target for each of the request, in its order.
void WarnOfConfigurationChanges(const Console& console, const v1::Nominal& nominal,
                                const v1::CompensateRequest& request,
                                const v1::CompensateResponse& response);

}  // namespace truepose::cli
