// What handlers check before they change something.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "server/store/transaction.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::services {

// A robot that is there and not deleted. @returns kNotFound with a fault of `field`.
absl::StatusOr<v1::Robot> GetLiveRobot(store::Snapshot& snapshot, const std::string& name,
                                       const std::string& field);

}  // namespace truepose::services
