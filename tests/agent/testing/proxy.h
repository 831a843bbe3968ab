// A network between two programs: TCP on loopback on the one side, a unix socket on the other.
#pragma once

#include <atomic>
#include <list>
#include <mutex>
#include <random>
#include <string>
#include <thread>

namespace truepose::testing {

class Proxy {
 public:
  // @param target path of the unix socket that connections are handed on to.
  Proxy(std::string target, unsigned seed);
  ~Proxy();
  Proxy(const Proxy&) = delete;
  Proxy& operator=(const Proxy&) = delete;

  std::string address() const { return "127.0.0.1:" + std::to_string(port_); }

  // Connections end, and none is made, until Heal.
  void Cut() { cut_ = true; }
  // Nothing passes any more, while connections stay as they are: a cable that was pulled.
  void Stall() { stalled_ = true; }
  // Each piece of bytes waits so long.
  void Delay(int milliseconds) { delay_ms_ = milliseconds; }
  // A piece in so many is lost, and its connection with it.
  void Drop(int one_in) { drop_one_in_ = one_in; }
  void Heal();

 private:
  void AcceptAll();
  void Carry(int one, int other);
  // Hands on one piece. false: the connection ends.
  bool Pass(int from, int to);
  bool Loses();

  const std::string target_;
  std::mutex mutex_;  // of random_
  std::mt19937 random_;
  int listener_ = -1, port_ = 0;
  std::atomic<bool> ended_{false}, cut_{false}, stalled_{false};
  std::atomic<int> delay_ms_{0}, drop_one_in_{0};
  std::list<std::thread> carriers_;  // of the accepting thread
  std::thread acceptor_;
};

}  // namespace truepose::testing
