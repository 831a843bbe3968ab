#include "server/watch/wake_hub.h"

#include <chrono>
#include <utility>
#include <vector>

namespace truepose::watch {

// The listener runs with the entry's own lock, so that removing it waits for a call that runs.
struct WakeHub::Entry {
  std::recursive_mutex mutex;
  Listener listener;
};

WakeHub::WakeHub(const WakeHubOptions& options) : options_(options), thread_([this] { Run(); }) {}

WakeHub::~WakeHub() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  marked_.notify_all();
  thread_.join();
}

std::shared_ptr<void> WakeHub::Add(Listener listener) {
  auto entry = std::make_shared<Entry>();
  entry->listener = std::move(listener);
  const std::lock_guard lock(mutex_);
  const int64_t id = next_id_++;
  entries_[id] = entry;
  return {nullptr, [this, id, entry](void*) {
            {
              const std::lock_guard inner(mutex_);
              entries_.erase(id);
            }
            const std::lock_guard inner(entry->mutex);
            entry->listener = nullptr;
          }};
}

void WakeHub::Changed() {
  {
    const std::lock_guard lock(mutex_);
    if (std::exchange(changed_, true)) return;
  }
  marked_.notify_one();
}

int WakeHub::count() const {
  const std::lock_guard lock(mutex_);
  return static_cast<int>(entries_.size());
}

void WakeHub::Run() {
  absl::Time next_tick = absl::Now() + options_.tick;
  for (;;) {
    bool changed = false;
    {
      std::unique_lock lock(mutex_);
      marked_.wait_for(lock, absl::ToChronoNanoseconds(next_tick - absl::Now()),
                       [this] { return changed_ || stopping_; });
      if (stopping_) return;
      changed = std::exchange(changed_, false);
    }
    if (changed) Tell(Wake::kChanged);
    if (absl::Now() >= next_tick) {
      Tell(Wake::kTick);
      next_tick = absl::Now() + options_.tick;
    }
    std::this_thread::sleep_for(absl::ToChronoNanoseconds(options_.least_pause));
  }
}

void WakeHub::Tell(Wake wake) {
  std::vector<std::shared_ptr<Entry>> entries;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& [id, entry] : entries_) entries.push_back(entry);
  }
  for (const std::shared_ptr<Entry>& entry : entries) {
    const std::lock_guard lock(entry->mutex);
    if (!entry->listener) continue;
    const Listener listener = entry->listener;  // it may remove itself
    listener(wake);
  }
}

}  // namespace truepose::watch
