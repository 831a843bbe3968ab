#include "client/agent/lines/socket_address.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <netinet/in.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"

namespace truepose::agent {
namespace {

using Found = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

Found Look(std::string host, const std::string& port) {
  if (host.size() > 2 && host.front() == '[') host = host.substr(1, host.size() - 2);
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV | AI_PASSIVE;
  addrinfo* found = nullptr;
  if (getaddrinfo(host.c_str(), port.c_str(), &hints, &found) != 0) found = nullptr;
  return Found(found, &freeaddrinfo);
}

absl::StatusOr<int> Bind(const addrinfo& found, const std::string& address) {
  const int descriptor =
      socket(found.ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, IPPROTO_TCP);
  const int on = 1;
  setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  if (bind(descriptor, found.ai_addr, found.ai_addrlen) == 0 && listen(descriptor, 64) == 0)
    return descriptor;
  const int error = errno;
  close(descriptor);
  return absl::UnavailableError(
      absl::StrCat("can't listen at ", address, ": ", std::strerror(error)));
}

}  // namespace

absl::StatusOr<int> ListenAt(const std::string& address) {
  const size_t colon = address.rfind(':');
  if (colon != std::string::npos && colon > 0) {
    const Found found = Look(address.substr(0, colon), address.substr(colon + 1));
    if (found != nullptr) return Bind(*found, address);
  }
  return FaultStatus("listen", absl::StrCat("'", address, "'"),
                     "a numeric address and port, such as 127.0.0.1:7900");
}

std::string HostOf(const sockaddr_storage& peer) {
  char text[INET6_ADDRSTRLEN] = "";
  if (peer.ss_family == AF_INET)
    inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in&>(peer).sin_addr, text, sizeof(text));
  if (peer.ss_family == AF_INET6)
    inet_ntop(AF_INET6, &reinterpret_cast<const sockaddr_in6&>(peer).sin6_addr, text, sizeof(text));
  return text;
}

std::string AddressOf(int descriptor) {
  sockaddr_storage own{};
  socklen_t size = sizeof(own);
  getsockname(descriptor, reinterpret_cast<sockaddr*>(&own), &size);
  // The port stands at the same place in both.
  const int port = ntohs(reinterpret_cast<const sockaddr_in&>(own).sin_port);
  const std::string host = HostOf(own);
  return own.ss_family == AF_INET6 ? absl::StrCat("[", host, "]:", port)
                                   : absl::StrCat(host, ":", port);
}

bool IsLoopback(const std::string& host) { return host.rfind("127.", 0) == 0 || host == "::1"; }

}  // namespace truepose::agent
