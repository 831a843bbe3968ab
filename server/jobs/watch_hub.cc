#include "server/jobs/watch_hub.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <list>
#include <mutex>
#include <thread>
#include <utility>

#include "server/jobs/job_state.h"

namespace truepose::jobs {
namespace {

struct Watch {
  std::string name;
  WatchCallbacks callbacks;
  bool changed = true;                // since it was told last; the first telling is "the job now"
  std::atomic<bool> removed = false;  // no callback may begin
  std::string told;                   // the last message's bytes; only the hub's thread looks at it
};

using WatchPtr = std::shared_ptr<Watch>;

void End(const Watch& watch, const absl::Status& status) {
  if (!watch.removed && watch.callbacks.on_done) watch.callbacks.on_done(status);
}

// Tells the job if it differs from what was told. @returns whether that was the last.
bool Tell(Watch& watch, const absl::StatusOr<v1::CalibrationJob>& job) {
  if (!job.ok()) {
    End(watch, job.status());
    return true;
  }
  std::string bytes = job->SerializeAsString();
  if (bytes != watch.told && !watch.removed && watch.callbacks.on_job) watch.callbacks.on_job(*job);
  watch.told = std::move(bytes);
  if (!IsTerminal(job->state())) return false;
  End(watch, absl::OkStatus());
  return true;
}

}  // namespace

class WatchHub::Loop {
 public:
  explicit Loop(Load load) : load_(std::move(load)), thread_([this] { Run(); }) {}

  bool Add(const WatchPtr& watch) {
    const std::lock_guard lock(mutex_);
    if (stopping_) return false;
    watches_.push_back(watch);
    wake_.notify_one();
    return true;
  }

  // Waits for a callback of this watch that runs, unless it is that callback which removes it.
  void Remove(const WatchPtr& watch) {
    std::unique_lock lock(mutex_);
    watch->removed = true;
    watches_.remove(watch);
    if (std::this_thread::get_id() == thread_id_) return;
    told_.wait(lock, [&] { return telling_ != watch; });
  }

  void Changed(const std::string& name) {
    const std::lock_guard lock(mutex_);
    for (const WatchPtr& watch : watches_) watch->changed |= watch->name == name;
    wake_.notify_one();
  }

  void Stop() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    wake_.notify_one();
    if (thread_.joinable()) thread_.join();
  }

 private:
  void Run() {
    std::unique_lock lock(mutex_);
    thread_id_ = std::this_thread::get_id();
    while (!stopping_) {
      if (!TakeChanged()) {
        wake_.wait(lock);
        continue;
      }
      WithoutLock(lock, [this](Watch& watch) {
        if (Tell(watch, load_(watch.name))) watch.removed = true;
      });
    }
    while (!watches_.empty()) {
      telling_ = watches_.front();
      watches_.pop_front();
      WithoutLock(
          lock, [](Watch& watch) { End(watch, absl::UnavailableError("the server is stopping")); });
    }
  }

  // The next watch in turn, moved to the end so that a busy one can't starve the others.
  bool TakeChanged() {
    watches_.remove_if([](const WatchPtr& watch) { return watch->removed.load(); });
    const auto next = std::find_if(watches_.begin(), watches_.end(),
                                   [](const WatchPtr& watch) { return watch->changed; });
    if (next == watches_.end()) return false;
    telling_ = *next;
    telling_->changed = false;
    watches_.splice(watches_.end(), watches_, next);
    return true;
  }

  // The callbacks run without the lock, and go without it, too: what they hold may come back to
  // this hub.
  template <typename Action>
  void WithoutLock(std::unique_lock<std::mutex>& lock, Action action) {
    WatchPtr watch = telling_;
    lock.unlock();
    action(*watch);
    lock.lock();
    telling_ = nullptr;
    told_.notify_all();
    lock.unlock();
    watch = nullptr;
    lock.lock();
  }

  const Load load_;
  std::mutex mutex_;  // of all below
  std::condition_variable wake_;
  std::condition_variable told_;
  std::list<WatchPtr> watches_;
  WatchPtr telling_;  // whose callbacks may be running
  bool stopping_ = false;
  std::thread::id thread_id_;
  std::thread thread_;
};

namespace {

class HubSubscription : public Subscription {
 public:
  explicit HubSubscription(std::function<void()> remove) : remove_(std::move(remove)) {}
  ~HubSubscription() override { remove_(); }

 private:
  std::function<void()> remove_;
};

}  // namespace

WatchHub::WatchHub(Load load) : loop_(std::make_shared<Loop>(std::move(load))) {}

WatchHub::~WatchHub() { Stop(); }

std::unique_ptr<Subscription> WatchHub::Add(std::string name, WatchCallbacks callbacks) {
  auto watch = std::make_shared<Watch>();
  watch->name = std::move(name);
  watch->callbacks = std::move(callbacks);
  if (!loop_->Add(watch)) return nullptr;
  return std::make_unique<HubSubscription>([loop = loop_, watch] { loop->Remove(watch); });
}

void WatchHub::Changed(const std::string& name) { loop_->Changed(name); }

void WatchHub::Stop() { loop_->Stop(); }

}  // namespace truepose::jobs
