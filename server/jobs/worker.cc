#include "server/jobs/worker.h"

#include <exception>
#include <memory>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"

namespace truepose::jobs {
namespace {

using store::Snapshot;
using store::Transaction;

// A full or failing disk may be well again in a moment.
bool IsTransient(const absl::Status& status) {
  return absl::IsResourceExhausted(status) || absl::IsUnavailable(status) ||
         absl::IsAborted(status);
}

Outcome Failure(absl::Status error) {
  return {.kind = Outcome::Kind::kError, .calibration = {}, .error = error};
}

Outcome Ended(Outcome::Kind kind) { return {.kind = kind, .calibration = {}, .error = {}}; }

// The input, and whether the job was asked to end before this worker could be told so.
struct Loaded {
  v1::CalibrationInput input;
  bool cancel_requested = false;
};

absl::StatusOr<Loaded> Load(store::Store& store, const std::string& name) {
  return store.Read([&name](Snapshot& snapshot) -> absl::StatusOr<Loaded> {
    Loaded loaded;
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::CalibrationJob job, store::GetJob(snapshot, name));
    TRUEPOSE_ASSIGN_OR_RETURN(loaded.input, store::LoadJobInput(snapshot, job));
    loaded.cancel_requested = job.cancel_requested();
    return loaded;
  });
}

}  // namespace

void Worker::Loop() {
  while (!context_.signal.IsStopping()) {
    const uint64_t seen = context_.signal.Wakes();
    const absl::StatusOr<std::optional<Claim>> claim = ClaimNext();
    if (!claim.ok()) {
      Warn("no job can be claimed", claim.status());
      context_.signal.Pause(context_.options.store_retry);
    } else if (claim->has_value()) {
      RunClaim(**claim);
    } else {
      context_.signal.WaitForWake(seen);
    }
  }
}

// Looks before it writes: a commit for nothing would cost a sync of the disk.
absl::StatusOr<std::optional<Claim>> Worker::ClaimNext() {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::optional<std::string> waiting,
                            context_.store.Read([](Snapshot& snapshot) {
                              return store::OldestInState(snapshot, v1::PENDING);
                            }));
  if (!waiting.has_value()) return std::optional<Claim>();
  return context_.store.Write([](Transaction& transaction) { return ClaimOldest(transaction); });
}

void Worker::RunClaim(const Claim& claim) {
  const std::string& name = claim.job.name();
  const std::shared_ptr<RunningJob> running = context_.running.Add(name);
  context_.on_changed(name);
  StoreOutcome(claim, Execute(claim, *running));
  context_.running.Remove(name);
  context_.on_changed(name);
}

Outcome Worker::Execute(const Claim& claim, RunningJob& running) {
  const absl::Duration end = context_.clock.Monotonic() + context_.options.deadline;
  const auto is_late = [&] { return context_.clock.Monotonic() >= end; };
  RunnerHooks hooks;
  hooks.on_progress = [&](const v1::JobProgress& progress) {
    running.SetProgress(progress);
    context_.on_changed(claim.job.name());
  };
  hooks.is_cancelled = [&] {
    return running.IsAskedToEnd() || context_.signal.IsStopping() || is_late();
  };

  const absl::StatusOr<Loaded> loaded = Load(context_.store, claim.job.name());
  if (!loaded.ok()) return Failure(loaded.status());
  if (loaded->cancel_requested) running.AskToEnd();
  absl::StatusOr<v1::Calibration> result = CallRunner(loaded->input, hooks);
  if (running.IsAskedToEnd()) return Ended(Outcome::Kind::kCancelled);
  if (is_late()) {
    return Failure(absl::DeadlineExceededError(
        absl::StrCat("took longer than ", absl::FormatDuration(context_.options.deadline))));
  }
  if (result.ok())
    return {.kind = Outcome::Kind::kResult, .calibration = *std::move(result), .error = {}};
  const bool stopped = absl::IsCancelled(result.status()) && context_.signal.IsStopping();
  return stopped ? Ended(Outcome::Kind::kStopped) : Failure(result.status());
}

absl::StatusOr<v1::Calibration> Worker::CallRunner(const v1::CalibrationInput& input,
                                                   const RunnerHooks& hooks) {
  // An input for which memory doesn't suffice must fail its job, not the server.
  try {
    if (hooks.is_cancelled()) return absl::CancelledError("asked to end before it began");
    return context_.runner(input, hooks);
  } catch (const std::exception& exception) {
    return absl::InternalError(
        absl::StrCat("the calibration ended with an exception: ", exception.what()));
  }
}

void Worker::StoreOutcome(const Claim& claim, Outcome outcome) {
  for (;;) {
    const absl::Status status =
        context_.store
            .Write([&](Transaction& transaction) { return EndJob(transaction, claim, outcome); })
            .status();
    if (status.ok()) return;
    Warn(absl::StrCat("the end of ", claim.job.name(), " can't be stored"), status);
    if (outcome.kind == Outcome::Kind::kResult && !IsTransient(status)) outcome = Failure(status);
    if (!context_.signal.Pause(context_.options.store_retry)) return;
  }
}

void Worker::Warn(const std::string& what, const absl::Status& status) {
  if (context_.options.on_warning)
    context_.options.on_warning(absl::StrCat(what, ": ", status.ToString()));
}

}  // namespace truepose::jobs
