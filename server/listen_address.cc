#include "server/listen_address.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string_view>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::server {
namespace {

constexpr char kExpected[] = "loopback host:port such as 127.0.0.1:7878, or unix:path";

class Socket {
 public:
  explicit Socket(int family) : fd_(socket(family, SOCK_STREAM | SOCK_CLOEXEC, 0)) {}
  ~Socket() {
    if (fd_ >= 0) close(fd_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  int fd() const { return fd_; }

 private:
  const int fd_;
};

absl::Status Refused(const std::string& found, const std::string& expected) {
  FaultList faults;
  faults.Add("listen", found, expected);
  return faults.ToStatus(absl::StatusCode::kUnavailable);
}

bool IsLoopback(const std::string& host) {
  return host == "localhost" || host == "::1" ||
         (host.starts_with("127.") && inet_addr(host.c_str()) != INADDR_NONE);
}

absl::StatusOr<ListenAddress> ParseUnix(const std::string& path) {
  if (path.empty()) return FaultStatus("listen", "'unix:' without a path", kExpected);
  if (path.size() >= sizeof(sockaddr_un::sun_path)) {
    return FaultStatus("listen", absl::StrCat("a socket path of ", path.size(), " bytes"),
                       absl::StrCat("at most ", sizeof(sockaddr_un::sun_path) - 1));
  }
  return ListenAddress{.unix_path = path};
}

// Fills in the system's form of a loopback address. @returns its size.
socklen_t ToSystem(const ListenAddress& address, sockaddr_storage* out) {
  if (address.host == "::1") {
    auto* v6 = reinterpret_cast<sockaddr_in6*>(out);
    v6->sin6_family = AF_INET6;
    v6->sin6_port = htons(address.port);
    v6->sin6_addr = in6addr_loopback;
    return sizeof(sockaddr_in6);
  }
  auto* v4 = reinterpret_cast<sockaddr_in*>(out);
  v4->sin_family = AF_INET;
  v4->sin_port = htons(address.port);
  v4->sin_addr.s_addr = inet_addr(address.host == "localhost" ? "127.0.0.1" : address.host.c_str());
  return sizeof(sockaddr_in);
}

absl::Status CheckTcpFree(const ListenAddress& address) {
  sockaddr_storage system{};
  const socklen_t size = ToSystem(address, &system);
  const Socket probe(system.ss_family);
  const int on = 1;  // as gRPC sets it: connections of the past don't count
  setsockopt(probe.fd(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  if (bind(probe.fd(), reinterpret_cast<const sockaddr*>(&system), size) == 0 &&
      listen(probe.fd(), 1) == 0) {
    return absl::OkStatus();
  }
  const std::string place = absl::StrCat(address.host, ":", address.port);
  if (errno == EADDRINUSE) {
    return Refused(absl::StrCat(place, " in use by another process"),
                   "an address that is free, or port 0");
  }
  return Refused(absl::StrCat(place, ": ", std::strerror(errno)), kExpected);
}

absl::Status CheckUnixFree(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) {
    const std::string folder =
        path.find('/') == std::string::npos ? "." : path.substr(0, path.rfind('/') + 1);
    if (access(folder.c_str(), W_OK | X_OK) == 0) return absl::OkStatus();
    return Refused(absl::StrCat("folder '", folder, "': ", std::strerror(errno)),
                   "a folder that can be written");
  }
  if (!S_ISSOCK(status.st_mode))
    return Refused(absl::StrCat("'", path, "' is a file"), "a socket, or nothing yet");
  sockaddr_un system{};
  system.sun_family = AF_UNIX;
  std::strncpy(system.sun_path, path.c_str(), sizeof(system.sun_path) - 1);
  const Socket probe(AF_UNIX);
  if (connect(probe.fd(), reinterpret_cast<const sockaddr*>(&system), sizeof(system)) == 0) {
    return Refused(absl::StrCat("'", path, "' in use by another process"),
                   "a socket that nobody listens at");
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<ListenAddress> ParseListenAddress(const std::string& text) {
  if (text.starts_with("unix:")) return ParseUnix(text.substr(5));
  const size_t colon = text.rfind(':');
  int port = -1;
  if (colon == std::string::npos || colon == 0 ||
      !absl::SimpleAtoi(text.substr(colon + 1), &port) || port < 0 || port > 65535) {
    return FaultStatus("listen", absl::StrCat("'", text, "'"), kExpected);
  }
  std::string host = text.substr(0, colon);
  if (host.front() == '[' && host.back() == ']') host = host.substr(1, host.size() - 2);
  if (!IsLoopback(host)) {
    return FaultStatus("listen", absl::StrCat("'", text, "', which others can reach"),
                       absl::StrCat(kExpected, ": calls are not encrypted, their tokens neither"));
  }
  return ListenAddress{.host = host, .port = port};
}

absl::Status CheckFree(const ListenAddress& address) {
  return address.unix_path.empty() ? CheckTcpFree(address) : CheckUnixFree(address.unix_path);
}

}  // namespace truepose::server
