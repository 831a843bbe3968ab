// The thread that delivers.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include "client/agent/delivery/audit.h"
#include "client/agent/spool/spool.h"
#include "client/client.h"

namespace truepose::agent {

struct DeliveryOptions {
  std::chrono::seconds keep = std::chrono::hours(7 * 24);  // after the seal, of done sessions
  std::chrono::milliseconds first_pause{100};              // after a failed call, doubled
  std::chrono::milliseconds longest_pause{1'000};          // up to this
  std::chrono::milliseconds refused_pause{60'000};         // for a session that was refused
  std::chrono::milliseconds audit_interval{10 * 60'000};  // besides those after each new connection
};

struct DeliveryState {
  bool connected = false;         // the last call was answered
  std::string problem;            // why not; "" while connected
  int64_t delivered = 0;          // readings acknowledged since the start, repeats included
  int64_t reopened_sessions = 0;  // that the server had lost
};

class Delivery {
 public:
  // @param log gets what a person should know, a line each, from the thread.
  Delivery(Spool& spool, const client::Client& client, DeliveryOptions options,
           std::function<void(const std::string&)> log);
  // Ends the thread; waits for the call that is under way.
  ~Delivery();
  Delivery(const Delivery&) = delete;
  Delivery& operator=(const Delivery&) = delete;

  // There is something to send.
  void Notify();
  // The server was away: it may be another one now, or know less. Everything is asked for again.
  void DistrustServer();
  // Asks the thread to end without waiting for it.
  void RequestStop();
  // Of what the server said last.
  DeliveryState state() const;

 private:
  using Time = std::chrono::steady_clock::time_point;

  void RunThread();
  // One pass over all sessions. @returns how long to wait before the next when nothing comes.
  std::chrono::milliseconds DeliverAll();
  // false: the server is away.
  bool DeliverOne(const Spool::Session& session);
  bool NeedsDelivery(const SessionFile& session) const;
  // Audits what is due, until there is something to send. false: the server is away.
  bool AuditSome();
  bool TakeStatus(const absl::Status& status);
  bool WaitForWork(std::chrono::milliseconds time);
  bool has_work() const;

  Spool& spool_;
  const client::Client& client_;
  const DeliveryOptions options_;
  const std::function<void(const std::string&)> log_;

  // Of the thread only.
  std::map<std::string, Time> refused_until_;
  std::deque<DoneSession> to_audit_;
  Time next_audit_{};
  EmptySince empty_since_;
  std::chrono::milliseconds pause_{0};

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool notified_ = true, distrusted_ = true, stopping_ = false;
  DeliveryState state_;
  std::thread thread_;
};

}  // namespace truepose::agent
