#include "client/agent/notify.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>

namespace truepose::agent {

// A name with a leading @ is an abstract socket: its first byte is 0.
void NotifySystemd(std::string_view state) {
  const char* const name = std::getenv("NOTIFY_SOCKET");
  sockaddr_un address{};
  if (name == nullptr || std::strlen(name) >= sizeof(address.sun_path)) return;
  address.sun_family = AF_UNIX;
  std::strcpy(address.sun_path, name);
  if (*name == '@') address.sun_path[0] = '\0';
  const int descriptor = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + std::strlen(name));
  sendto(descriptor, state.data(), state.size(), MSG_NOSIGNAL,
         reinterpret_cast<const sockaddr*>(&address), size);
  close(descriptor);
}

std::chrono::milliseconds WatchdogInterval() {
  const char* const microseconds = std::getenv("WATCHDOG_USEC");
  if (microseconds == nullptr) return std::chrono::milliseconds(0);
  return std::chrono::milliseconds(std::atoll(microseconds) / 2000);
}

}  // namespace truepose::agent
