// Progress of a run in stages.
#pragma once

#include <cmath>
#include <memory>
#include <string>

#include "core/base/hooks.h"

namespace truepose {

// Turns the solver's iterations into a fraction that only grows: half of what is left every 20
// iterations.
class StagedHooks {
 public:
  explicit StagedHooks(const Hooks& hooks) : hooks_(hooks) {}

  Hooks For(const std::string& stage, double from, double to) {
    Hooks staged;
    staged.is_cancelled = hooks_.is_cancelled;
    auto count = std::make_shared<int>(0);
    staged.on_progress = [this, stage, from, to, count](const Progress& progress) {
      const double share = 1 - std::exp2(-++*count / 20.0);
      hooks_.Report({stage, from + (to - from) * share, progress.iteration, progress.cost});
    };
    hooks_.Report({stage, from, 0, 0});
    return staged;
  }

 private:
  const Hooks& hooks_;
};

}  // namespace truepose
