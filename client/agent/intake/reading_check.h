// Readings that the server will take.
#pragma once

#include <string>

#include "core/base/fault.h"
#include "truepose/v1/session.pb.h"

namespace truepose::agent {

// Serialised; a batch of a thousand has to fit into a message of 16 MB.
inline constexpr int64_t kLargestReading = 15'000;

// Every fault of a reading of a robot with so many joints, fields below `field`: the server's rules
// (convert/rules/reading_rules.h), and text that is no UTF-8. It must hold `joints_measured` or
// `joints_commanded`, without which nobody knows where the robot stood.
void CheckReading(const v1::Reading& reading, int joints, const std::string& field,
                  FaultList* faults);

}  // namespace truepose::agent
