#include "server/jobs/running_jobs.h"

namespace truepose::jobs {

void RunningJob::SetProgress(const v1::JobProgress& progress) {
  const std::lock_guard lock(mutex_);
  progress_ = progress;
}

v1::JobProgress RunningJob::Progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

std::shared_ptr<RunningJob> RunningJobs::Add(const std::string& name) {
  auto job = std::make_shared<RunningJob>();
  const std::lock_guard lock(mutex_);
  jobs_[name] = job;
  return job;
}

void RunningJobs::Remove(const std::string& name) {
  const std::lock_guard lock(mutex_);
  jobs_.erase(name);
}

std::shared_ptr<RunningJob> RunningJobs::Find(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = jobs_.find(name);
  return found == jobs_.end() ? nullptr : found->second;
}

}  // namespace truepose::jobs
