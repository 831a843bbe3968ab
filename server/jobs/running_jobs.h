// The jobs that this process runs: their claim, their progress, when their worker last showed that
// it lives, and whether they are asked to end. In memory only.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "absl/time/time.h"
#include "server/jobs/transitions.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::jobs {

class RunningJob {
 public:
  // @param now monotonic; the first sign of life.
  RunningJob(Claim claim, absl::Duration now) : claim_(std::move(claim)), last_beat_(now) {}

  const Claim& claim() const { return claim_; }

  void AskToEnd() { asked_to_end_ = true; }
  bool IsAskedToEnd() const { return asked_to_end_; }

  // Renews the lease: the worker lives at `now`, monotonic.
  void Beat(absl::Duration now);
  absl::Duration LastBeat() const;
  // The run ends in one of two ways, whichever comes first: its worker has brought it to an end, or
  // its lease was taken back and the worker is to give up. Each @returns whether it came first.
  bool Finish();
  bool Lose();

  void SetProgress(const v1::JobProgress& progress);
  v1::JobProgress Progress() const;

 private:
  const Claim claim_;
  std::atomic<bool> asked_to_end_ = false;
  std::atomic<bool> is_over_ = false;
  mutable std::mutex mutex_;  // of all below
  absl::Duration last_beat_;
  v1::JobProgress progress_;
};

class RunningJobs {
 public:
  std::shared_ptr<RunningJob> Add(const Claim& claim, absl::Duration now);
  // Not if another run of the same job has taken its place.
  void Remove(const std::shared_ptr<RunningJob>& job);
  // nullptr when this process doesn't run it.
  std::shared_ptr<RunningJob> Find(const std::string& name) const;
  std::vector<std::shared_ptr<RunningJob>> All() const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<RunningJob>> jobs_;
};

}  // namespace truepose::jobs
