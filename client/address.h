// The addresses of a server that a person may write.
#pragma once

#include <string>

#include "absl/status/status.h"

namespace truepose::client {

// "host:port" with a port from 1 to 65535, "[v6]:port", or "unix:path".
// @returns kInvalidArgument with a fault that says what is missing.
absl::Status ValidateAddress(const std::string& address);

}  // namespace truepose::client
