#include "tests/agent/testing/line_client.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace truepose::testing {

void LineClient::Connect(const std::string& address) {
  Close();
  sockaddr_in peer{};
  peer.sin_family = AF_INET;
  peer.sin_port = htons(static_cast<uint16_t>(std::stoi(address.substr(address.rfind(':') + 1))));
  peer.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  descriptor_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int on = 1;
  setsockopt(descriptor_, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  if (connect(descriptor_, reinterpret_cast<sockaddr*>(&peer), sizeof(peer)) != 0) Close();
}

void LineClient::Close() {
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = -1;
  in_.clear();
}

bool LineClient::Send(const std::string& bytes) {
  size_t sent = 0;
  while (sent < bytes.size()) {
    const ssize_t n = send(descriptor_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (n <= 0) return false;
    sent += static_cast<size_t>(n);
  }
  return true;
}

std::optional<std::string> LineClient::ReadLine() {
  while (true) {
    const size_t end = in_.find('\n');
    if (end != std::string::npos) {
      std::string line = in_.substr(0, end);
      in_.erase(0, end + 1);
      return line;
    }
    pollfd waited{descriptor_, POLLIN, 0};
    if (poll(&waited, 1, 30'000) <= 0) return std::nullopt;
    char bytes[4096];
    const ssize_t n = recv(descriptor_, bytes, sizeof(bytes), 0);
    if (n <= 0) return std::nullopt;
    in_.append(bytes, static_cast<size_t>(n));
  }
}

std::optional<nlohmann::json> LineClient::Ask(const nlohmann::json& message) {
  if (!connected() || !Send(message.dump() + "\n")) return std::nullopt;
  const auto line = ReadLine();
  return line.has_value() ? std::optional(nlohmann::json::parse(*line)) : std::nullopt;
}

}  // namespace truepose::testing
