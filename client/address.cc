#include "client/address.h"

#include <string_view>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "core/base/fault.h"

namespace truepose::client {
namespace {

constexpr char kExpected[] = "host:port such as 127.0.0.1:7878, or unix:path";

absl::Status Bad(const std::string& address) {
  return FaultStatus("server address", absl::StrCat("'", address, "'"), kExpected);
}

// A host of several colons is an IPv6 address, which needs brackets to tell its end from the port.
bool IsHost(std::string_view host) {
  if (host.empty()) return false;
  if (host.front() == '[') return host.size() > 2 && host.back() == ']';
  return host.find_first_of(":/") == std::string_view::npos;
}

}  // namespace

absl::Status ValidateAddress(const std::string& address) {
  if (address.starts_with("unix:")) {
    return address.size() > 5 ? absl::OkStatus() : Bad(address);
  }
  const size_t colon = address.rfind(':');
  if (colon == std::string::npos || !IsHost(std::string_view(address).substr(0, colon))) {
    return Bad(address);
  }
  int port = 0;
  if (!absl::SimpleAtoi(address.substr(colon + 1), &port) || port < 1 || port > 65535) {
    return Bad(address);
  }
  return absl::OkStatus();
}

}  // namespace truepose::client
