// What tests of the engine share: runs that end when the test says so, and a watcher that
// remembers.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "server/jobs/engine.h"
#include "server/jobs/runner.h"
#include "server/jobs/watch.h"
#include "server/store/store.h"

namespace truepose::jobs {

// Long enough for a loaded machine; a test that waits so long has failed.
inline constexpr std::chrono::seconds kPatience{30};

// Runs that last until the test ends them, or until they are asked to end.
class HandRunner {
 public:
  Runner AsRunner();

  // Every run, now and later, ends with this.
  void EndWith(absl::StatusOr<v1::Calibration> result);
  // Runs take no notice of being asked to end.
  void IgnoreCancellation();
  // Runs call no hook any more, as if they hung, until EndWith.
  void FallSilent();
  // Told once by the run that is going on.
  void Report(double fraction);

  // Waits until so many runs have begun. @returns whether they have.
  bool WaitForRuns(int count);
  // Inputs in the order in which runs began.
  std::vector<v1::CalibrationInput> Inputs() const;

 private:
  absl::StatusOr<v1::Calibration> Run(const v1::CalibrationInput& input, const RunnerHooks& hooks);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<v1::CalibrationInput> inputs_;
  std::optional<absl::StatusOr<v1::Calibration>> result_;
  std::vector<double> reports_;
  bool ignores_cancellation_ = false;
  bool is_silent_ = false;
};

// Watches a job and keeps all that it is told.
class Watching {
 public:
  Watching(JobEngine& engine, const std::string& name);

  // Waits until something told fits. @returns whether that came.
  bool WaitFor(const std::function<bool(const v1::CalibrationJob&)>& fits);
  bool WaitForState(v1::JobState state);
  // The end of the watch.
  absl::Status WaitForEnd();
  std::vector<v1::CalibrationJob> Seen() const;
  void Unsubscribe() { subscription_ = nullptr; }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<v1::CalibrationJob> seen_;
  std::optional<absl::Status> end_;
  std::unique_ptr<Subscription> subscription_;
};

// Waits for the end of a job. @returns it as it is then.
v1::CalibrationJob Finish(JobEngine& engine, const std::string& name);

// The job as it is stored, and the number of calibrations of robots/ur10.
v1::CalibrationJob Stored(store::Store& store, const std::string& name);
int CalibrationCount(store::Store& store);

// Options of an engine that a test doesn't have to wait for.
EngineOptions QuickOptions();

}  // namespace truepose::jobs
