// A sink that keeps in memory what sources hand over, and can be told to refuse.
#pragma once

#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "client/agent/sources/session_feed.h"

namespace truepose::agent {

struct FakeSession {
  v1::Session content;
  std::vector<v1::Reading> readings;
  bool sealed = false;
};

// Keeps the contract of ReadingSink: repeats have no effect, other content is refused.
class FakeSink : public ReadingSink {
 public:
  absl::StatusOr<SessionProgress> Begin(const SessionStart& start) override;
  absl::StatusOr<int64_t> Append(const std::string& session, int64_t first_number,
                                 const std::vector<v1::Reading>& readings) override;
  absl::StatusOr<SessionProgress> Seal(const std::string& session, int64_t readings) override;
  // The task that was set; it is done when its session is sealed.
  absl::StatusOr<MeasuringTask> Task(const std::string& robot) override;
  void SetTask(MeasuringTask task);

  // Asked before every Append; a status that is not OK is the answer.
  void RefuseAppend(std::function<absl::Status(const std::vector<v1::Reading>&)> refuse);
  void RefuseBegin(absl::Status status);

  // Waits until `condition` of the sessions, in the order of their beginning, is true; false after
  // 30 s, which no test should ever see.
  bool WaitFor(const std::function<bool(const std::vector<FakeSession>&)>& condition);
  std::vector<FakeSession> Sessions() const;

  // Readings of a session as "1.5 2.5": their first joints.
  static std::string Joints(const FakeSession& session);

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<FakeSession> sessions_;
  std::map<std::string, size_t> by_name_;  // key or id -> index
  std::function<absl::Status(const std::vector<v1::Reading>&)> refuse_;
  absl::Status refuse_begin_;
  std::optional<MeasuringTask> task_;
};

// Faults as lines, for any thread.
class Faults {
 public:
  FaultReport Report() {
    return [this](const Fault& fault) {
      const std::lock_guard lock(mutex_);
      text_ += ToString(fault) + "\n";
    };
  }
  std::string Text() const {
    const std::lock_guard lock(mutex_);
    return text_;
  }

 private:
  mutable std::mutex mutex_;
  std::string text_;
};

// Two joints that turn.
v1::Nominal TwoJoints();

}  // namespace truepose::agent
