// The jobs that this process runs: their progress and whether they are asked to end. In memory
// only.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "truepose/v1/calibration.pb.h"

namespace truepose::jobs {

class RunningJob {
 public:
  void AskToEnd() { asked_to_end_ = true; }
  bool IsAskedToEnd() const { return asked_to_end_; }

  void SetProgress(const v1::JobProgress& progress);
  v1::JobProgress Progress() const;

 private:
  std::atomic<bool> asked_to_end_ = false;
  mutable std::mutex mutex_;
  v1::JobProgress progress_;
};

class RunningJobs {
 public:
  std::shared_ptr<RunningJob> Add(const std::string& name);
  void Remove(const std::string& name);
  // nullptr when this process doesn't run it.
  std::shared_ptr<RunningJob> Find(const std::string& name) const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<RunningJob>> jobs_;
};

}  // namespace truepose::jobs
