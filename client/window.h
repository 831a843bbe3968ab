// Between a thread that sends and one that takes acknowledgements.
#pragma once

#include <condition_variable>
#include <mutex>

namespace truepose::client {

// How many batches may be under way.
class Window {
 public:
  explicit Window(int size) : free_(size) {}

  // Waits for room. false: the window was closed.
  bool Enter() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || free_ > 0; });
    if (closed_) return false;
    --free_;
    return true;
  }
  void Leave() {
    std::lock_guard lock(mutex_);
    ++free_;
    changed_.notify_one();
  }
  void Close() {
    std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_one();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int free_;
  bool closed_ = false;
};

}  // namespace truepose::client
