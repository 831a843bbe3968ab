// How long work in the core reports and is stopped. Both are called from the working thread and
// must not block.
#pragma once

#include <functional>
#include <string>

namespace truepose {

struct Progress {
  std::string stage;    // "start_values", "identification", "assessment"
  double fraction = 0;  // 0 to 1, never decreasing in one run
  int iteration = 0;
  double cost = 0;
};

struct Hooks {
  std::function<void(const Progress&)> on_progress;
  std::function<bool()> is_cancelled;

  bool Cancelled() const { return is_cancelled && is_cancelled(); }
  void Report(const Progress& progress) const {
    if (on_progress) on_progress(progress);
  }
};

}  // namespace truepose
