#include "tests/jobs/engine_testing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "server/store/calibrations.h"
#include "server/store/jobs.h"

namespace truepose::jobs {

Runner HandRunner::AsRunner() {
  return [this](const v1::CalibrationInput& input, const RunnerHooks& hooks) {
    return Run(input, hooks);
  };
}

void HandRunner::EndWith(absl::StatusOr<v1::Calibration> result) {
  const std::lock_guard lock(mutex_);
  result_ = std::move(result);
  changed_.notify_all();
}

void HandRunner::IgnoreCancellation() {
  const std::lock_guard lock(mutex_);
  ignores_cancellation_ = true;
}

void HandRunner::FallSilent() {
  const std::lock_guard lock(mutex_);
  is_silent_ = true;
}

void HandRunner::Report(double fraction) {
  const std::lock_guard lock(mutex_);
  reports_.push_back(fraction);
  changed_.notify_all();
}

bool HandRunner::WaitForRuns(int count) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, kPatience,
                           [&] { return static_cast<int>(inputs_.size()) >= count; });
}

std::vector<v1::CalibrationInput> HandRunner::Inputs() const {
  const std::lock_guard lock(mutex_);
  return inputs_;
}

absl::StatusOr<v1::Calibration> HandRunner::Run(const v1::CalibrationInput& input,
                                                const RunnerHooks& hooks) {
  std::unique_lock lock(mutex_);
  inputs_.push_back(input);
  changed_.notify_all();
  for (;;) {
    for (const double fraction : std::exchange(reports_, {})) {
      v1::JobProgress progress;
      progress.set_fraction(fraction);
      hooks.on_progress(progress);
    }
    if (result_.has_value()) return *result_;
    // Asked also when the answer is ignored: it is the run's sign of life.
    if (!is_silent_ && hooks.is_cancelled() && !ignores_cancellation_)
      return absl::CancelledError("asked to end");
    changed_.wait_for(lock, std::chrono::milliseconds(1));
  }
}

Watching::Watching(JobEngine& engine, const std::string& name) {
  WatchCallbacks callbacks;
  callbacks.on_job = [this](const v1::CalibrationJob& job) {
    const std::lock_guard lock(mutex_);
    seen_.push_back(job);
    changed_.notify_all();
  };
  callbacks.on_done = [this](const absl::Status& status) {
    const std::lock_guard lock(mutex_);
    end_ = status;
    changed_.notify_all();
  };
  auto subscription = engine.Watch(name, std::move(callbacks));
  EXPECT_TRUE(subscription.ok()) << subscription.status();
  if (subscription.ok()) subscription_ = *std::move(subscription);
}

bool Watching::WaitFor(const std::function<bool(const v1::CalibrationJob&)>& fits) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, kPatience,
                           [&] { return std::any_of(seen_.begin(), seen_.end(), fits); });
}

bool Watching::WaitForState(v1::JobState state) {
  return WaitFor([state](const v1::CalibrationJob& job) { return job.state() == state; });
}

absl::Status Watching::WaitForEnd() {
  std::unique_lock lock(mutex_);
  if (!changed_.wait_for(lock, kPatience, [&] { return end_.has_value(); })) {
    return absl::DeadlineExceededError("the watch doesn't end");
  }
  return *end_;
}

std::vector<v1::CalibrationJob> Watching::Seen() const {
  const std::lock_guard lock(mutex_);
  return seen_;
}

v1::CalibrationJob Finish(JobEngine& engine, const std::string& name) {
  Watching watching(engine, name);
  EXPECT_TRUE(watching.WaitForEnd().ok());
  return *engine.Get(name);
}

v1::CalibrationJob Stored(store::Store& store, const std::string& name) {
  const auto job =
      store.Read([&](store::Snapshot& snapshot) { return store::GetJob(snapshot, name); });
  EXPECT_TRUE(job.ok()) << job.status();
  return job.ok() ? *job : v1::CalibrationJob();
}

int CalibrationCount(store::Store& store) {
  const auto page = store.Read([](store::Snapshot& snapshot) {
    return store::ListCalibrations(snapshot, "robots/ur10", {.size = 1000, .token = ""});
  });
  EXPECT_TRUE(page.ok()) << page.status();
  return page.ok() ? static_cast<int>(page->items.size()) : -1;
}

EngineOptions QuickOptions() {
  EngineOptions options;
  options.store_retry = absl::Milliseconds(1);
  options.sweep = absl::Milliseconds(1);
  // Tests turn the clock between two signs of life; those of leases say how long they are.
  options.lease = absl::Hours(1000);
  return options;
}

}  // namespace truepose::jobs
