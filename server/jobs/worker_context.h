// What the threads of one engine share.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/strings/str_cat.h"
#include "server/jobs/engine.h"
#include "server/jobs/runner.h"
#include "server/jobs/running_jobs.h"
#include "server/jobs/stop_signal.h"
#include "server/store/store.h"

namespace truepose::jobs {

// All of it outlives the threads.
struct WorkerContext {
  store::Store& store;
  const Runners& runners;
  const EngineOptions& options;
  const store::Clock& clock;
  StopSignal& signal;
  RunningJobs& running;
  std::function<void(const std::string&)> on_changed;  // a job's state or progress, by name

  // A place of failpoints.h.
  void At(std::string_view point) const {
    if (options.at_point) options.at_point(point);
  }
  // Tells EngineOptions::on_end of a job that this transaction has ended; of another nothing.
  absl::Status TellEnd(store::Transaction& transaction, const std::string& name) const;
  void Warn(const std::string& what, const absl::Status& status) const {
    if (options.on_warning) options.on_warning(absl::StrCat(what, ": ", status.ToString()));
  }
};

}  // namespace truepose::jobs
