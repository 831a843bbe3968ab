// Corrections of joints that are larger than those of a calibrated robot.
#pragma once

#include "client/cli/console.h"
#include "truepose/v1/robot.pb.h"
#include "truepose/v1/services.pb.h"

namespace truepose::cli {

// One warning on console.err when joints of targets that were asked for as joints change by more
// than programs::CorrectOptions allows a program: how many targets, and of the first its row, joint
// and change. Poses have no joints to compare with.
// @param response with a target for each of the request, in its order.
void WarnOfLargeChanges(const Console& console, const v1::Nominal& nominal,
                        const v1::CompensateRequest& request,
                        const v1::CompensateResponse& response);

}  // namespace truepose::cli
