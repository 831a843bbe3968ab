#include "server/jobs/worker.h"

#include <memory>
#include <utility>

#include "core/base/status_macros.h"
#include "server/jobs/execution.h"
#include "server/store/calibrations.h"
#include "server/store/jobs.h"

namespace truepose::jobs {
namespace {

using store::Snapshot;
using store::Transaction;

// A full or failing disk may be well again in a moment.
bool IsTransient(const absl::Status& status) {
  return absl::IsResourceExhausted(status) || absl::IsUnavailable(status) ||
         absl::IsAborted(status);
}

}  // namespace

void Worker::Loop() {
  while (!context_.signal.IsStopping()) {
    const uint64_t seen = context_.signal.Wakes();
    const absl::StatusOr<std::optional<Claim>> claim = ClaimNext();
    if (!claim.ok()) {
      context_.Warn("no job can be claimed", claim.status());
      context_.signal.Pause(context_.options.store_retry);
    } else if (claim->has_value()) {
      if (!RunClaim(**claim)) return;
    } else {
      context_.signal.WaitForWake(seen);
    }
  }
}

// Looks before it writes: a commit for nothing would cost a sync of the disk.
absl::StatusOr<std::optional<Claim>> Worker::ClaimNext() {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::optional<std::string> waiting,
                            context_.store.Read([this](Snapshot& snapshot) {
                              return store::NextJob(snapshot, context_.clock.Now());
                            }));
  if (!waiting.has_value()) return std::optional<Claim>();
  context_.At("before_claim");
  return context_.store.Write([this](Transaction& transaction) {
    context_.At("in_claim");
    auto claim = jobs::ClaimNext(transaction);
    context_.At("claim_written");
    return claim;
  });
}

bool Worker::RunClaim(const Claim& claim) {
  context_.At("after_claim");
  const std::string& name = claim.job.name();
  const auto running = context_.running.Add(claim, context_.clock.Monotonic());
  context_.on_changed(name);
  StoreOutcome(*running, Execute(context_, *running));
  context_.running.Remove(running);
  context_.on_changed(name);
  // The robot is free for whoever passed over its next job.
  context_.signal.Wake();
  return running->Finish();
}

absl::StatusOr<bool> Worker::EndWithResult(Transaction& transaction, const Claim& claim,
                                           const Outcome& outcome) {
  TRUEPOSE_ASSIGN_OR_RETURN(const bool ended, EndJob(transaction, claim, outcome));
  if (!ended) return ended;
  TRUEPOSE_RETURN_IF_ERROR(TellResult(transaction, claim));
  TRUEPOSE_RETURN_IF_ERROR(context_.TellEnd(transaction, claim.job.name()));
  return ended;
}

absl::Status Worker::TellResult(Transaction& transaction, const Claim& claim) {
  if (!context_.options.with_result) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::CalibrationJob job,
                            store::GetJob(transaction, claim.job.name()));
  if (job.state() != v1::SUCCEEDED || !job.compensation_table().empty()) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Calibration calibration,
                            store::GetCalibration(transaction, job.calibration()));
  return context_.options.with_result(transaction, calibration);
}

void Worker::StoreOutcome(RunningJob& running, Outcome outcome) {
  const Claim& claim = running.claim();
  context_.At("before_end");
  for (;;) {
    running.Beat(context_.clock.Monotonic());
    const absl::Status status = context_.store
                                    .Write([&](Transaction& transaction) {
                                      context_.At("in_end");
                                      auto ended = EndWithResult(transaction, claim, outcome);
                                      context_.At("end_written");
                                      return ended;
                                    })
                                    .status();
    if (status.ok()) return context_.At("after_end");
    context_.Warn(absl::StrCat("the end of ", claim.job.name(), " can't be stored"), status);
    if (outcome.kind == Outcome::Kind::kResult && !IsTransient(status))
      outcome = {.kind = Outcome::Kind::kError, .error = status};
    if (!context_.signal.Pause(context_.options.store_retry)) return;
  }
}

}  // namespace truepose::jobs
