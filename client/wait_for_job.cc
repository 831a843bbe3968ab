#include "client/wait_for_job.h"

#include <thread>

#include "core/base/status_macros.h"

namespace truepose::client {
namespace {

using Clock = std::chrono::steady_clock;

// One wait over as many streams and looks as it takes.
class Wait {
 public:
  Wait(const Client& client, const std::string& name, const WaitOptions& options)
      : client_(client), name_(name), options_(options) {}

  absl::StatusOr<v1::CalibrationJob> Run();

 private:
  // Takes over what the server said of the job; true while more is to come.
  bool Take(const v1::CalibrationJob& job);
  absl::Status Watch();
  absl::Status Look();
  absl::Status WatchOrLook();
  bool ShouldGoOn(const absl::Status& status) const;
  bool IsCancelled() const { return options_.is_cancelled && options_.is_cancelled(); }
  void Pause() const;

  const Client& client_;
  const std::string& name_;
  const WaitOptions& options_;
  v1::CalibrationJob job_;
  bool streams_pass_ = true;
  Clock::time_point last_answer_ = Clock::now();
};

absl::StatusOr<v1::CalibrationJob> Wait::Run() {
  while (!IsTerminal(job_.state())) {
    const absl::Status status = WatchOrLook();
    if (IsTerminal(job_.state())) break;
    if (!ShouldGoOn(status)) return status;
    if (IsCancelled()) return absl::CancelledError("the wait was ended; the job goes on");
    Pause();
  }
  return job_;
}

bool Wait::Take(const v1::CalibrationJob& job) {
  job_ = job;
  last_answer_ = Clock::now();
  if (options_.on_change) options_.on_change(job_);
  return !IsTerminal(job_.state());
}

absl::Status Wait::Watch() {
  return client_.WatchCalibrationJob(
      name_, [this](const v1::CalibrationJob& job) { return Take(job); }, options_.is_cancelled);
}

absl::Status Wait::Look() {
  v1::GetCalibrationJobRequest request;
  request.set_name(name_);
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::CalibrationJob job, client_.GetCalibrationJob(request));
  Take(job);
  return absl::OkStatus();
}

// A proxy that does not pass streams answers with kUnimplemented; a stream that another end cut is
// tried again.
absl::Status Wait::WatchOrLook() {
  if (!streams_pass_) return Look();
  const absl::Status status = Watch();
  if (!absl::IsUnimplemented(status)) return status;
  streams_pass_ = false;
  return Look();
}

bool Wait::ShouldGoOn(const absl::Status& status) const {
  if (status.ok()) return true;
  const bool may_come_back = absl::IsUnavailable(status) || absl::IsDeadlineExceeded(status);
  return may_come_back && Clock::now() - last_answer_ < options_.patience;
}

// In slices, so that a person who gives up is heard.
void Wait::Pause() const {
  const Clock::time_point end = Clock::now() + options_.poll_interval;
  while (Clock::now() < end && !IsCancelled()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

}  // namespace

bool IsTerminal(v1::JobState state) {
  return state == v1::SUCCEEDED || state == v1::FAILED || state == v1::CANCELLED;
}

absl::StatusOr<v1::CalibrationJob> WaitForJob(const Client& client, const std::string& name,
                                              const WaitOptions& options) {
  return Wait(client, name, options).Run();
}

}  // namespace truepose::client
