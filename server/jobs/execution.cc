#include "server/jobs/execution.h"

#include <algorithm>
#include <exception>
#include <utility>
#include <variant>

#include "core/base/status_macros.h"
#include "server/jobs/time_left.h"
#include "server/store/checksum.h"

namespace truepose::jobs {
namespace {

using store::Snapshot;

Outcome Failure(absl::Status error) {
  return {.kind = Outcome::Kind::kError, .error = std::move(error)};
}

Outcome Ended(Outcome::Kind kind) { return {.kind = kind}; }

// The input, and whether the job was asked to end before this worker could be told so.
struct Loaded {
  std::variant<v1::CalibrationInput, v1::CompensationTableInput> input;
  bool cancel_requested = false;
};

absl::StatusOr<Loaded> Load(const WorkerContext& context, const std::string& name) {
  return context.store.Read([&](Snapshot& snapshot) -> absl::StatusOr<Loaded> {
    context.At("in_load");
    Loaded loaded;
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::CalibrationJob job, store::GetJob(snapshot, name));
    if (job.compensation_table().empty()) {
      TRUEPOSE_ASSIGN_OR_RETURN(loaded.input, store::LoadJobInput(snapshot, job));
    } else {
      TRUEPOSE_ASSIGN_OR_RETURN(loaded.input, store::LoadTableInput(snapshot, job));
    }
    loaded.cancel_requested = job.cancel_requested();
    return loaded;
  });
}

absl::StatusOr<Outcome> Calibrate(const Runners& runners, const v1::CalibrationInput& input,
                                  const RunnerHooks& hooks) {
  if (!runners.calibrate) return absl::UnimplementedError("this server does not calibrate");
  Outcome outcome{.kind = Outcome::Kind::kResult};
  TRUEPOSE_ASSIGN_OR_RETURN(outcome.calibration, runners.calibrate(input, hooks));
  return outcome;
}

// The digest is computed here: in the transaction it would hold up the writer.
absl::StatusOr<Outcome> BuildTable(const Runners& runners, const v1::CompensationTableInput& input,
                                   const RunnerHooks& hooks) {
  if (!runners.build_table)
    return absl::UnimplementedError("this server builds no compensation tables");
  TRUEPOSE_ASSIGN_OR_RETURN(BuiltTable built, runners.build_table(input, hooks));
  std::string sha256 = store::Sha256Hex(built.bytes);
  Outcome outcome{.kind = Outcome::Kind::kResult};
  outcome.table = {std::move(built.bytes), std::move(sha256), std::move(built.header)};
  return outcome;
}

// When a run has to have ended, in monotonic time, and what is said when it hasn't.
struct TimeLimit {
  absl::Duration end;
  std::string reason;
};

TimeLimit LimitOf(const WorkerContext& context, const v1::CalibrationJob& job) {
  const absl::Duration now = context.clock.Monotonic();
  const absl::Duration left = store::DeadlineOf(job) - context.clock.Now();
  if (left < context.options.deadline) {
    return {now + left, absl::StrCat("its deadline ",
                                     absl::FormatTime(store::DeadlineOf(job), absl::UTCTimeZone()),
                                     " passed before it ended")};
  }
  return {now + context.options.deadline,
          absl::StrCat("took longer than ", absl::FormatDuration(context.options.deadline))};
}

class Execution {
 public:
  Execution(const WorkerContext& context, RunningJob& running)
      : context_(context),
        running_(running),
        name_(running.claim().job.name()),
        begin_(context.clock.Monotonic()),
        limit_(LimitOf(context, running.claim().job)) {}

  Outcome Run() {
    context_.At("before_load");
    const absl::StatusOr<Loaded> loaded = Load(context_, name_);
    if (!loaded.ok()) return Failure(loaded.status());
    if (loaded->cancel_requested) running_.AskToEnd();
    context_.At("after_load");
    return OutcomeOf(CallRunner(*loaded));
  }

 private:
  bool IsLate() const { return context_.clock.Monotonic() >= limit_.end; }

  bool IsToEnd() {
    running_.Beat(context_.clock.Monotonic());
    return running_.IsAskedToEnd() || context_.signal.IsStopping() || IsLate();
  }

  void Tell(v1::JobProgress progress) {
    const absl::Duration now = context_.clock.Monotonic();
    running_.Beat(now);
    const auto left = SecondsLeft(now - begin_, progress.fraction());
    if (left.has_value()) progress.set_seconds_left(*left);
    running_.SetProgress(progress);
    context_.on_changed(name_);
    context_.At("in_run");
  }

  absl::StatusOr<Outcome> CallRunner(const Loaded& loaded) {
    const RunnerHooks hooks{
        .on_progress = [this](const v1::JobProgress& progress) { Tell(progress); },
        .is_cancelled = [this] { return IsToEnd(); }};
    // An input for which memory doesn't suffice must fail its job, not the server.
    try {
      if (IsToEnd()) return absl::CancelledError("asked to end before it began");
      context_.At("before_run");
      const auto* table = std::get_if<v1::CompensationTableInput>(&loaded.input);
      absl::StatusOr<Outcome> result =
          table != nullptr
              ? BuildTable(context_.runners, *table, hooks)
              : Calibrate(context_.runners, std::get<v1::CalibrationInput>(loaded.input), hooks);
      context_.At("after_run");
      return result;
    } catch (const std::exception& exception) {
      return absl::InternalError(
          absl::StrCat("the run ended with an exception: ", exception.what()));
    }
  }

  Outcome OutcomeOf(absl::StatusOr<Outcome> result) const {
    if (running_.IsAskedToEnd()) return Ended(Outcome::Kind::kCancelled);
    if (IsLate()) return Failure(absl::DeadlineExceededError(limit_.reason));
    if (result.ok()) return *std::move(result);
    const bool stopped = absl::IsCancelled(result.status()) && context_.signal.IsStopping();
    return stopped ? Ended(Outcome::Kind::kStopped) : Failure(result.status());
  }

  const WorkerContext& context_;
  RunningJob& running_;
  const std::string name_;
  const absl::Duration begin_;
  const TimeLimit limit_;
};

}  // namespace

Outcome Execute(const WorkerContext& context, RunningJob& running) {
  return Execution(context, running).Run();
}

}  // namespace truepose::jobs
