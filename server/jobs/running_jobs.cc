#include "server/jobs/running_jobs.h"

namespace truepose::jobs {

void RunningJob::Beat(absl::Duration now) {
  const std::lock_guard lock(mutex_);
  last_beat_ = now;
}

absl::Duration RunningJob::LastBeat() const {
  const std::lock_guard lock(mutex_);
  return last_beat_;
}

bool RunningJob::Finish() { return !is_over_.exchange(true); }

bool RunningJob::Lose() {
  AskToEnd();
  return !is_over_.exchange(true);
}

void RunningJob::SetProgress(const v1::JobProgress& progress) {
  const std::lock_guard lock(mutex_);
  progress_ = progress;
}

v1::JobProgress RunningJob::Progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

std::shared_ptr<RunningJob> RunningJobs::Add(const Claim& claim, absl::Duration now) {
  auto job = std::make_shared<RunningJob>(claim, now);
  const std::lock_guard lock(mutex_);
  jobs_[claim.job.name()] = job;
  return job;
}

void RunningJobs::Remove(const std::shared_ptr<RunningJob>& job) {
  const std::lock_guard lock(mutex_);
  const auto found = jobs_.find(job->claim().job.name());
  if (found != jobs_.end() && found->second == job) jobs_.erase(found);
}

std::shared_ptr<RunningJob> RunningJobs::Find(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = jobs_.find(name);
  return found == jobs_.end() ? nullptr : found->second;
}

std::vector<std::shared_ptr<RunningJob>> RunningJobs::All() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<RunningJob>> all;
  for (const auto& [name, job] : jobs_) all.push_back(job);
  return all;
}

}  // namespace truepose::jobs
