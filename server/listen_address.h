// Where a server may listen, and whether the place is free.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace truepose::server {

struct ListenAddress {
  std::string unix_path = {};  // set, or
  std::string host = {};       // a loopback address without brackets
  int port = 0;                // 0: any that is free
};

// "unix:path", "127.0.0.1:7878", "localhost:0", "[::1]:7878".
// Calls are not encrypted yet, and a token that others can read is theirs, so only a unix socket
// and loopback are taken.
// @returns kInvalidArgument with a fault of the field `listen`.
absl::StatusOr<ListenAddress> ParseListenAddress(const std::string& text);

// Asks the system before anything else is opened, because gRPC would remove the socket file of a
// running server and says little of why an address can't be had. A socket file that nobody answers
// at is left over and is fine.
// @returns kUnavailable with a fault of the field `listen`: taken, not ours, not permitted.
absl::Status CheckFree(const ListenAddress& address);

}  // namespace truepose::server
