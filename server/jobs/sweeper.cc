#include "server/jobs/sweeper.h"

#include <memory>
#include <string>
#include <vector>

#include "core/base/status_macros.h"

namespace truepose::jobs {

using store::Snapshot;
using store::Transaction;

void Sweeper::Loop() {
  do {
    FailLateJobs();
    TakeBackSilentJobs();
  } while (context_.signal.Pause(context_.options.sweep));
}

// Looks before it writes: a commit for nothing would cost a sync of the disk.
void Sweeper::FailLateJobs() {
  auto late = context_.store.Read([this](Snapshot& snapshot) {
    return store::LatePendingJobs(snapshot, context_.clock.Now(), 1);
  });
  if (late.ok() && !late->empty())
    late = context_.store.Write([this](Transaction& transaction) { return EndLate(transaction); });
  if (!late.ok()) return context_.Warn("jobs beyond their deadline can't be ended", late.status());
  for (const std::string& name : *late) context_.on_changed(name);
}

absl::StatusOr<std::vector<std::string>> Sweeper::EndLate(Transaction& transaction) {
  TRUEPOSE_ASSIGN_OR_RETURN(std::vector<std::string> names, FailLate(transaction));
  for (const std::string& name : names)
    TRUEPOSE_RETURN_IF_ERROR(context_.TellEnd(transaction, name));
  return names;
}

absl::StatusOr<bool> Sweeper::TakeBackOne(Transaction& transaction, const Claim& claim,
                                          const std::string& reason) {
  TRUEPOSE_ASSIGN_OR_RETURN(const bool taken,
                            TakeBack(transaction, claim, context_.options.max_attempts, reason));
  if (taken) TRUEPOSE_RETURN_IF_ERROR(context_.TellEnd(transaction, claim.job.name()));
  return taken;
}

void Sweeper::TakeBackSilentJobs() {
  const std::string reason = absl::StrCat("its worker gave no sign of life for ",
                                          absl::FormatDuration(context_.options.lease));
  for (const std::shared_ptr<RunningJob>& job : context_.running.All()) {
    if (context_.clock.Monotonic() - job->LastBeat() <= context_.options.lease) continue;
    const Claim& claim = job->claim();
    const auto taken = context_.store.Write(
        [&](Transaction& transaction) { return TakeBackOne(transaction, claim, reason); });
    if (!taken.ok())
      context_.Warn(absl::StrCat(claim.job.name(), " can't be taken back"), taken.status());
    if (!taken.ok() || !*taken) continue;
    context_.running.Remove(job);
    context_.on_changed(claim.job.name());
    if (job->Lose()) replace_worker_();
    context_.signal.Wake();
  }
}

}  // namespace truepose::jobs
