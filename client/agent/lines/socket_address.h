// Numeric addresses and sockets.
#pragma once

#include <sys/socket.h>

#include <string>

#include "absl/status/statusor.h"

namespace truepose::agent {

// A socket that listens at "host:port", host being a numeric address, IPv6 in brackets.
// @returns kInvalidArgument for what isn't such an address, kUnavailable with the system's reason.
absl::StatusOr<int> ListenAt(const std::string& address);

// "127.0.0.1:7900" or "[::1]:7900" of a socket's own end.
std::string AddressOf(int descriptor);
// "127.0.0.1" or "::1".
std::string HostOf(const sockaddr_storage& peer);
bool IsLoopback(const std::string& host);

}  // namespace truepose::agent
