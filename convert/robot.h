// Nominal messages to core robots.
#pragma once

#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "core/robot/robot.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::convert {

// @returns kInvalidArgument with every fault, field paths of v1::Nominal.
absl::StatusOr<Robot> RobotFrom(const v1::Nominal& nominal);

// X_FT of a tool by name. kInvalidArgument with a fault of `field` that lists the tools there are.
absl::StatusOr<Pose> ToolByName(const v1::Nominal& nominal, const std::string& name,
                                const std::string& field);

}  // namespace truepose::convert
