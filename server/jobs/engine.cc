#include "server/jobs/engine.h"

#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/jobs/job_state.h"
#include "server/jobs/running_jobs.h"
#include "server/jobs/stop_signal.h"
#include "server/jobs/sweeper.h"
#include "server/jobs/transitions.h"
#include "server/jobs/watch_hub.h"
#include "server/jobs/worker.h"
#include "server/jobs/worker_context.h"

namespace truepose::jobs {

using store::Snapshot;
using store::Transaction;

absl::Status EngineOptions::Validate() const {
  FaultList faults;
  if (workers < 1 || workers > 64) faults.Add("workers", absl::StrCat(workers), "1 to 64");
  if (deadline <= absl::ZeroDuration())
    faults.Add("deadline", absl::FormatDuration(deadline), "more than 0");
  if (max_attempts < 1) faults.Add("max_attempts", absl::StrCat(max_attempts), "1 or more");
  if (lease <= absl::ZeroDuration())
    faults.Add("lease", absl::FormatDuration(lease), "more than 0");
  if (sweep <= absl::ZeroDuration())
    faults.Add("sweep", absl::FormatDuration(sweep), "more than 0");
  if (store_retry <= absl::ZeroDuration())
    faults.Add("store_retry", absl::FormatDuration(store_retry), "more than 0");
  return faults.ToStatus();
}

class JobEngine::State {
 public:
  State(store::Store& store, Runners runners, EngineOptions options, const store::Clock& clock)
      : store_(store),
        runners_(std::move(runners)),
        options_(std::move(options)),
        context_{store_,
                 runners_,
                 options_,
                 clock,
                 signal_,
                 running_,
                 [this](const std::string& name) { hub_.Changed(name); }},
        worker_(context_),
        sweeper_(context_, [this] { AddWorker(); }),
        hub_([this](const std::string& name) { return Get(name); }) {}

  absl::Status Start() {
    TRUEPOSE_RETURN_IF_ERROR(options_.Validate());
    const std::lock_guard lock(mutex_);
    if (!threads_.empty() || signal_.IsStopping())
      return absl::FailedPreconditionError("the engine was started before");
    TRUEPOSE_ASSIGN_OR_RETURN(const std::vector<std::string> recovered, Recover());
    for (const std::string& name : recovered) hub_.Changed(name);
    for (int i = 0; i < options_.workers; ++i) threads_.emplace_back([this] { worker_.Loop(); });
    sweeping_ = std::thread([this] { sweeper_.Loop(); });
    return absl::OkStatus();
  }

  void Stop() {
    signal_.Stop();
    const std::lock_guard stop_lock(stop_mutex_);
    // First the one that adds workers.
    if (std::thread sweeping = Take(sweeping_); sweeping.joinable()) sweeping.join();
    for (std::thread& thread : Take(threads_)) thread.join();
    hub_.Stop();
  }

  void Wake() { signal_.Wake(); }

  absl::StatusOr<v1::CalibrationJob> Get(const std::string& name) {
    TRUEPOSE_ASSIGN_OR_RETURN(v1::CalibrationJob job, store_.Read([&](Snapshot& snapshot) {
      return store::GetJob(snapshot, name);
    }));
    const std::shared_ptr<RunningJob> running = running_.Find(name);
    if (running != nullptr && job.state() == v1::RUNNING)
      *job.mutable_progress() = running->Progress();
    return job;
  }

  absl::StatusOr<v1::CalibrationJob> Cancel(const std::string& name, const Within& within) {
    context_.At("before_cancel");
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::CalibrationJob job,
                              store_.Write([&](Transaction& transaction) {
                                const Effect cancel = [&] { return CancelOne(transaction, name); };
                                auto asked = within ? within(transaction, cancel) : cancel();
                                context_.At("cancel_written");
                                return asked;
                              }));
    context_.At("after_cancel");
    // After the commit: a worker that began meanwhile finds the request in the store.
    if (const std::shared_ptr<RunningJob> running = running_.Find(name)) running->AskToEnd();
    hub_.Changed(name);
    return job;
  }

  std::vector<v1::WatchedProgress> Progress(std::string_view robot) const {
    std::vector<v1::WatchedProgress> told;
    for (const std::shared_ptr<RunningJob>& running : running_.All()) {
      const v1::CalibrationJob& job = running->claim().job;
      v1::JobProgress progress = running->Progress();
      if ((!robot.empty() && job.robot() != robot) || progress.ByteSizeLong() == 0) continue;
      v1::WatchedProgress& one = told.emplace_back();
      one.set_job(job.name());
      *one.mutable_progress() = std::move(progress);
    }
    return told;
  }

  absl::StatusOr<v1::CompensationTableEstimate> EstimateTable(
      const v1::CompensationTableInput& input) const {
    if (runners_.estimate_table) return runners_.estimate_table(input);
    return absl::UnimplementedError("this server builds no compensation tables");
  }

  absl::StatusOr<std::unique_ptr<Subscription>> Watch(const std::string& name,
                                                      WatchCallbacks callbacks) {
    TRUEPOSE_RETURN_IF_ERROR(Get(name).status());
    std::unique_ptr<Subscription> subscription = hub_.Add(name, std::move(callbacks));
    if (subscription == nullptr) return absl::UnavailableError("the server is stopping");
    return subscription;
  }

 private:
  absl::StatusOr<v1::CalibrationJob> CancelOne(Transaction& transaction, const std::string& name) {
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::CalibrationJob before, store::GetJob(transaction, name));
    TRUEPOSE_ASSIGN_OR_RETURN(v1::CalibrationJob job, RequestCancel(transaction, name));
    if (!IsTerminal(before.state())) TRUEPOSE_RETURN_IF_ERROR(context_.TellEnd(transaction, name));
    return job;
  }

  absl::StatusOr<std::vector<std::string>> RecoverAll(Transaction& transaction) {
    TRUEPOSE_ASSIGN_OR_RETURN(std::vector<std::string> names,
                              RecoverRunning(transaction, options_.max_attempts));
    for (const std::string& name : names)
      TRUEPOSE_RETURN_IF_ERROR(context_.TellEnd(transaction, name));
    return names;
  }

  absl::StatusOr<std::vector<std::string>> Recover() {
    context_.At("before_recover");
    TRUEPOSE_ASSIGN_OR_RETURN(std::vector<std::string> names,
                              store_.Write([this](Transaction& transaction) {
                                auto recovered = RecoverAll(transaction);
                                context_.At("recover_written");
                                return recovered;
                              }));
    context_.At("after_recover");
    return names;
  }

  void AddWorker() {
    const std::lock_guard lock(mutex_);
    if (!signal_.IsStopping()) threads_.emplace_back([this] { worker_.Loop(); });
  }

  template <typename T>
  T Take(T& member) {
    const std::lock_guard lock(mutex_);
    return std::exchange(member, T());
  }

  store::Store& store_;
  const Runners runners_;
  const EngineOptions options_;
  StopSignal signal_;
  RunningJobs running_;
  const WorkerContext context_;
  Worker worker_;
  Sweeper sweeper_;
  WatchHub hub_;
  std::mutex stop_mutex_;  // one Stop() at a time
  std::mutex mutex_;       // of all below
  std::vector<std::thread> threads_;
  std::thread sweeping_;
};

JobEngine::JobEngine(store::Store& store, Runners runners, EngineOptions options,
                     const store::Clock& clock)
    : state_(std::make_unique<State>(store, std::move(runners), std::move(options), clock)) {}

JobEngine::~JobEngine() { Stop(); }

absl::Status JobEngine::Start() { return state_->Start(); }

void JobEngine::Stop() { state_->Stop(); }

void JobEngine::Wake() { state_->Wake(); }

absl::StatusOr<v1::CalibrationJob> JobEngine::Get(const std::string& name) {
  return state_->Get(name);
}

absl::StatusOr<v1::CalibrationJob> JobEngine::Cancel(const std::string& name,
                                                     const Within& within) {
  return state_->Cancel(name, within);
}

std::vector<v1::WatchedProgress> JobEngine::Progress(std::string_view robot) const {
  return state_->Progress(robot);
}

absl::StatusOr<v1::CompensationTableEstimate> JobEngine::EstimateTable(
    const v1::CompensationTableInput& input) const {
  return state_->EstimateTable(input);
}

absl::StatusOr<std::unique_ptr<Subscription>> JobEngine::Watch(const std::string& name,
                                                               WatchCallbacks callbacks) {
  return state_->Watch(name, std::move(callbacks));
}

}  // namespace truepose::jobs
