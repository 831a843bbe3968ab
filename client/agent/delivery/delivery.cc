#include "client/agent/delivery/delivery.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "client/agent/delivery/audit.h"
#include "client/agent/delivery/deliver_session.h"

namespace truepose::agent {
namespace {

// Codes that say nothing of the session.
bool IsOfServer(const absl::Status& status) {
  return absl::IsUnavailable(status) || absl::IsDeadlineExceeded(status) ||
         absl::IsUnauthenticated(status) || absl::IsPermissionDenied(status) ||
         absl::IsCancelled(status) || absl::IsResourceExhausted(status);
}

}  // namespace

Delivery::Delivery(Spool& spool, const client::Client& client, DeliveryOptions options,
                   std::function<void(const std::string&)> log)
    : spool_(spool), client_(client), options_(options), log_(std::move(log)) {
  thread_ = std::thread([this] { RunThread(); });
}

Delivery::~Delivery() {
  RequestStop();
  thread_.join();
}

void Delivery::Notify() {
  std::lock_guard lock(mutex_);
  notified_ = true;
  changed_.notify_all();
}

void Delivery::DistrustServer() {
  std::lock_guard lock(mutex_);
  distrusted_ = notified_ = true;
  changed_.notify_all();
}

void Delivery::RequestStop() {
  std::lock_guard lock(mutex_);
  stopping_ = true;
  changed_.notify_all();
}

DeliveryState Delivery::state() const {
  std::lock_guard lock(mutex_);
  return state_;
}

bool Delivery::has_work() const {
  std::lock_guard lock(mutex_);
  return notified_ || stopping_;
}

bool Delivery::WaitForWork(std::chrono::milliseconds time) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, time, [this] { return notified_ || stopping_; });
  notified_ = false;
  return !stopping_;
}

void Delivery::RunThread() {
  std::chrono::milliseconds wait{0};
  while (WaitForWork(wait)) {
    wait = DeliverAll();
    // After a failure nothing that comes in makes the server come back sooner.
    if (pause_.count() == 0) continue;
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, pause_, [this] { return stopping_; });
    wait = std::chrono::milliseconds(0);
  }
}

bool Delivery::NeedsDelivery(const SessionFile& session) const {
  const int64_t readings = session.readings();
  return readings > 0 && (session.delivered < readings || session.sealed());
}

std::chrono::milliseconds Delivery::DeliverAll() {
  {
    std::lock_guard lock(mutex_);
    if (std::exchange(distrusted_, false)) {
      for (const Spool::Session& session : spool_.Sessions()) session->delivered = -1;
      refused_until_.clear();
      next_audit_ = {};
    }
  }
  for (const Spool::Session& session : spool_.Sessions())
    if (NeedsDelivery(*session) && !DeliverOne(session)) return pause_;
  if (!AuditSome()) return pause_;
  pause_ = std::chrono::milliseconds(0);
  return to_audit_.empty() ? options_.longest_pause : std::chrono::milliseconds(0);
}

bool Delivery::TakeStatus(const absl::Status& status) {
  const bool away = IsOfServer(status);
  std::lock_guard lock(mutex_);
  if (away) distrusted_ = true;
  if (away && state_.connected) log_(std::string(status.message()));
  if (!away && !state_.connected) log_("the server answers");
  state_.connected = !away;
  state_.problem = away ? std::string(status.message()) : "";
  pause_ = away ? std::clamp(2 * pause_, options_.first_pause, options_.longest_pause)
                : std::chrono::milliseconds(0);
  return !away;
}

bool Delivery::DeliverOne(const Spool::Session& session) {
  const std::string& name = session->content().name();
  const auto refused = refused_until_.find(name);
  if (refused != refused_until_.end() && std::chrono::steady_clock::now() < refused->second)
    return true;
  const int64_t before = std::max<int64_t>(0, session->delivered);
  const auto sealed = DeliverSession(client_, *session);
  {
    std::lock_guard lock(mutex_);
    state_.delivered += std::max<int64_t>(0, session->delivered - before);
  }
  if (!TakeStatus(sealed.status())) return false;
  if (!sealed.ok()) {
    if (session->refusal().empty())
      log_(absl::StrCat(name, " is refused: ", std::string(sealed.status().message())));
    session->SetRefusal(std::string(sealed.status().message()));
    refused_until_[name] = std::chrono::steady_clock::now() + options_.refused_pause;
    return true;
  }
  refused_until_.erase(name);
  session->SetRefusal("");
  if (*sealed) {
    const absl::Status done = spool_.SetDone(name);
    log_(done.ok() ? absl::StrCat(name, " is delivered: ", session->readings(), " readings")
                   : std::string(done.message()));
  }
  return true;
}

bool Delivery::AuditSome() {
  const Time now = std::chrono::steady_clock::now();
  if (to_audit_.empty() && now >= next_audit_) {
    next_audit_ = now + options_.audit_interval;
    RemoveEmptySessions(spool_, options_.keep, empty_since_);
    for (const DoneSession& done : spool_.Done()) to_audit_.push_back(done);
  }
  while (!to_audit_.empty() && !has_work()) {
    const auto audited = AuditDone(client_, spool_, to_audit_.front(), options_.keep);
    if (!TakeStatus(audited.status())) return false;
    if (!audited.ok()) log_(std::string(audited.status().message()));
    if (audited.ok() && *audited == Audited::kReopened) {
      log_(to_audit_.front().session + " is not on the server any more and is sent again");
      std::lock_guard lock(mutex_);
      ++state_.reopened_sessions;
      notified_ = true;
    }
    to_audit_.pop_front();
  }
  return true;
}

}  // namespace truepose::agent
