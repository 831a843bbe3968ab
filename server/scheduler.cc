#include "server/scheduler.h"

#include <algorithm>
#include <utility>

#include "absl/strings/str_cat.h"

namespace truepose::server {
namespace {

// A clock under test is turned by hand and wakes nobody.
constexpr absl::Duration kLongestLook = absl::Seconds(1);

}  // namespace

Scheduler::Scheduler(std::vector<Task> tasks, absl::Duration every, const store::Clock& clock,
                     std::function<void(const std::string&)> on_warning)
    : tasks_(std::move(tasks)), every_(every), clock_(clock), on_warning_(std::move(on_warning)) {}

Scheduler::~Scheduler() { Stop(); }

void Scheduler::Start() {
  thread_ = std::thread([this] { Loop(); });
}

void Scheduler::Stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  stop_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Scheduler::Loop() {
  absl::Duration due = clock_.Monotonic();
  while (WaitUntil(due)) {
    due = clock_.Monotonic() + every_;
    RunAll();
  }
}

bool Scheduler::WaitUntil(absl::Duration due) {
  std::unique_lock lock(mutex_);
  for (;;) {
    if (stopping_) return false;
    const absl::Duration left = due - clock_.Monotonic();
    if (left <= absl::ZeroDuration()) return true;
    const absl::Duration look = std::min({left, every_, kLongestLook});
    stop_.wait_for(lock, absl::ToChronoNanoseconds(look), [this] { return stopping_; });
  }
}

bool Scheduler::IsStopping() {
  const std::lock_guard lock(mutex_);
  return stopping_;
}

void Scheduler::RunAll() {
  for (const Task& task : tasks_) {
    if (IsStopping()) return;
    const absl::Status status = task.run([this] { return IsStopping(); });
    if (!status.ok()) on_warning_(absl::StrCat(task.what, ": ", status.ToString()));
  }
}

}  // namespace truepose::server
