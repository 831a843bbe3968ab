// One worker: claims, runs and ends jobs until the stop. Several share the same surroundings.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "server/jobs/engine.h"
#include "server/jobs/runner.h"
#include "server/jobs/running_jobs.h"
#include "server/jobs/stop_signal.h"
#include "server/jobs/transitions.h"
#include "server/store/store.h"

namespace truepose::jobs {

// What workers share; all of it outlives them.
struct WorkerContext {
  store::Store& store;
  const Runner& runner;
  const EngineOptions& options;
  const store::Clock& clock;
  StopSignal& signal;
  RunningJobs& running;
  std::function<void(const std::string&)> on_changed;  // a job's state or progress, by name
};

class Worker {
 public:
  explicit Worker(const WorkerContext& context) : context_(context) {}

  // Works until the stop.
  void Loop();

 private:
  absl::StatusOr<std::optional<Claim>> ClaimNext();
  void RunClaim(const Claim& claim);
  Outcome Execute(const Claim& claim, RunningJob& running);
  absl::StatusOr<v1::Calibration> CallRunner(const v1::CalibrationInput& input,
                                             const RunnerHooks& hooks);
  // Until it is stored, the lease is lost, or the stop.
  void StoreOutcome(const Claim& claim, Outcome outcome);
  void Warn(const std::string& what, const absl::Status& status);

  const WorkerContext& context_;
};

}  // namespace truepose::jobs
