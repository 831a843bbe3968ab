// One worker: claims, runs and ends jobs until the stop. Several share the same surroundings.
#pragma once

#include <optional>

#include "absl/status/statusor.h"
#include "server/jobs/transitions.h"
#include "server/jobs/worker_context.h"

namespace truepose::jobs {

class Worker {
 public:
  explicit Worker(const WorkerContext& context) : context_(context) {}

  // Works until the stop, or until its lease is taken back: another worker has its place then.
  void Loop();

 private:
  absl::StatusOr<std::optional<Claim>> ClaimNext();
  // @returns false when the lease was taken back meanwhile.
  bool RunClaim(const Claim& claim);
  // The end of the job, and what goes with its result, in one transaction.
  absl::StatusOr<bool> EndWithResult(store::Transaction& transaction, const Claim& claim,
                                     const Outcome& outcome);
  absl::Status TellResult(store::Transaction& transaction, const Claim& claim);
  // Until it is stored, the lease is lost, or the stop.
  void StoreOutcome(RunningJob& running, Outcome outcome);

  const WorkerContext& context_;
};

}  // namespace truepose::jobs
