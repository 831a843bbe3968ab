// Looks after the jobs that no worker ends: those that wait beyond their deadline, and those whose
// worker gives no sign of life. One thread an engine.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "server/jobs/worker_context.h"

namespace truepose::jobs {

class Sweeper {
 public:
  // @param replace_worker called for each worker whose lease was taken back: its thread may hang
  // for ever, and the queue must go on.
  Sweeper(const WorkerContext& context, std::function<void()> replace_worker)
      : context_(context), replace_worker_(std::move(replace_worker)) {}

  // Looks every EngineOptions::sweep until the stop.
  void Loop();

 private:
  void FailLateJobs();
  void TakeBackSilentJobs();
  absl::StatusOr<std::vector<std::string>> EndLate(store::Transaction& transaction);
  absl::StatusOr<bool> TakeBackOne(store::Transaction& transaction, const Claim& claim,
                                   const std::string& reason);

  const WorkerContext& context_;
  const std::function<void()> replace_worker_;
};

}  // namespace truepose::jobs
