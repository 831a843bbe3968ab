// Tells watchers that there may be something to send.
#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <thread>

#include "absl/time/clock.h"
#include "absl/time/time.h"

namespace truepose::watch {

enum class Wake {
  kChanged,  // something was committed, or a running job has got further
  kTick,     // time has passed
};

struct WakeHubOptions {
  absl::Duration least_pause = absl::Milliseconds(5);  // commits within it are told as one
  absl::Duration tick = absl::Seconds(1);
};

// All functions are safe from any thread.
class WakeHub {
 public:
  using Listener = std::function<void(Wake)>;

  explicit WakeHub(const WakeHubOptions& options = {});
  // Ends its thread. Listeners that are left are not called again.
  ~WakeHub();

  // `listener` is called from the hub's thread and must be quick. It is called no more once what
  // this returns is destroyed, which waits for a call that runs; it may be destroyed within that
  // call.
  [[nodiscard]] std::shared_ptr<void> Add(Listener listener);
  // Quick: sets a mark.
  void Changed();
  int count() const;

 private:
  struct Entry;

  void Run();
  void Tell(Wake wake);

  const WakeHubOptions options_;
  mutable std::mutex mutex_;
  std::condition_variable marked_;
  std::map<int64_t, std::shared_ptr<Entry>> entries_;
  int64_t next_id_ = 0;
  bool changed_ = false, stopping_ = false;
  std::thread thread_;
};

}  // namespace truepose::watch
