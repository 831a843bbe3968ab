#include "tests/agent/testing/proxy.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <chrono>
#include <cstring>

namespace truepose::testing {
namespace {

constexpr int kTick_ms = 10;  // how soon a changed network is seen

int ConnectTo(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
  const int descriptor = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (connect(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof(address)) == 0)
    return descriptor;
  close(descriptor);
  return -1;
}

}  // namespace

Proxy::Proxy(std::string target, unsigned seed) : target_(std::move(target)), random_(seed) {
  listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in own{};
  own.sin_family = AF_INET;
  own.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(own);
  bind(listener_, reinterpret_cast<sockaddr*>(&own), size);
  listen(listener_, 16);
  getsockname(listener_, reinterpret_cast<sockaddr*>(&own), &size);
  port_ = ntohs(own.sin_port);
  acceptor_ = std::thread([this] { AcceptAll(); });
}

Proxy::~Proxy() {
  ended_ = true;
  acceptor_.join();
  close(listener_);
}

void Proxy::Heal() {
  cut_ = stalled_ = false;
  delay_ms_ = drop_one_in_ = 0;
}

void Proxy::AcceptAll() {
  while (!ended_) {
    pollfd waited{listener_, POLLIN, 0};
    if (poll(&waited, 1, kTick_ms) <= 0) continue;
    const int client = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    const int server = cut_ ? -1 : ConnectTo(target_);
    if (server < 0) {
      close(client);
      continue;
    }
    carriers_.emplace_back([this, client, server] { Carry(client, server); });
  }
  for (std::thread& carrier : carriers_) carrier.join();
}

void Proxy::Carry(int one, int other) {
  bool open = true;
  while (open && !ended_ && !cut_) {
    pollfd waited[] = {{one, POLLIN, 0}, {other, POLLIN, 0}};
    if (stalled_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(kTick_ms));
      continue;
    }
    if (poll(waited, 2, kTick_ms) <= 0) continue;
    if (waited[0].revents != 0) open = Pass(one, other);
    if (open && waited[1].revents != 0) open = Pass(other, one);
  }
  close(one);
  close(other);
}

bool Proxy::Loses() {
  if (drop_one_in_ == 0) return false;
  std::lock_guard lock(mutex_);
  return std::uniform_int_distribution<int>(1, drop_one_in_)(random_) == 1;
}

bool Proxy::Pass(int from, int to) {
  char bytes[16 << 10];
  const ssize_t n = recv(from, bytes, sizeof(bytes), 0);
  if (n <= 0) return false;
  if (delay_ms_ > 0) std::this_thread::sleep_for(std::chrono::milliseconds(delay_ms_));
  // Half of it arrives: what the other end has then is the begin of a message.
  const ssize_t passed = Loses() ? n / 2 : n;
  return send(to, bytes, static_cast<size_t>(passed), MSG_NOSIGNAL) == n;
}

}  // namespace truepose::testing
