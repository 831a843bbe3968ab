#include "tests/agent/sources/fake_sink.h"

#include <chrono>

#include "formats/number.h"

namespace truepose::agent {

absl::StatusOr<SessionProgress> FakeSink::Begin(const SessionStart& start) {
  const std::lock_guard lock(mutex_);
  if (!refuse_begin_.ok()) return refuse_begin_;
  if (start.for_request && !task_.has_value()) return absl::FailedPreconditionError("no request");
  const std::string given = start.for_request ? task_->request : start.id + start.key;
  const std::string name = given.empty() ? "new " + std::to_string(sessions_.size()) : given;
  const auto [place, is_new] = by_name_.try_emplace(name, sessions_.size());
  if (is_new) sessions_.push_back({start.content, {}, false});
  changed_.notify_all();
  const FakeSession& session = sessions_[place->second];
  SessionProgress progress;
  progress.session = std::to_string(place->second);
  progress.robot = session.content.robot();
  progress.readings = static_cast<int64_t>(session.readings.size());
  progress.sealed = session.sealed;
  return progress;
}

absl::StatusOr<int64_t> FakeSink::Append(const std::string& name, int64_t first_number,
                                         const std::vector<v1::Reading>& readings) {
  const std::lock_guard lock(mutex_);
  if (const absl::Status status = refuse_ ? refuse_(readings) : absl::OkStatus(); !status.ok())
    return status;
  FakeSession& session = sessions_[std::stoul(name)];
  for (size_t i = 0; i < readings.size(); ++i) {
    const size_t number = static_cast<size_t>(first_number) + i;
    if (number > session.readings.size() + 1) return absl::OutOfRangeError("a gap");
    if (number == session.readings.size() + 1) {
      if (session.sealed) return absl::FailedPreconditionError("sealed");
      session.readings.push_back(readings[i]);
    } else if (session.readings[number - 1].SerializeAsString() !=
               readings[i].SerializeAsString()) {
      return absl::AbortedError("another content");
    }
  }
  changed_.notify_all();
  return static_cast<int64_t>(session.readings.size());
}

absl::StatusOr<SessionProgress> FakeSink::Seal(const std::string& name, int64_t readings) {
  const std::lock_guard lock(mutex_);
  FakeSession& session = sessions_[std::stoul(name)];
  if (readings != static_cast<int64_t>(session.readings.size()))
    return absl::InvalidArgumentError("another number of readings");
  session.sealed = true;
  if (task_.has_value() && by_name_.contains(task_->request) &&
      by_name_[task_->request] == std::stoul(name))
    task_.reset();
  changed_.notify_all();
  SessionProgress progress;
  progress.session = name;
  progress.readings = readings;
  progress.sealed = true;
  return progress;
}

absl::StatusOr<MeasuringTask> FakeSink::Task(const std::string&) {
  const std::lock_guard lock(mutex_);
  if (!task_.has_value()) return absl::NotFoundError("no request");
  return *task_;
}

void FakeSink::SetTask(MeasuringTask task) {
  const std::lock_guard lock(mutex_);
  task_ = std::move(task);
}

void FakeSink::RefuseAppend(std::function<absl::Status(const std::vector<v1::Reading>&)> refuse) {
  const std::lock_guard lock(mutex_);
  refuse_ = std::move(refuse);
}

void FakeSink::RefuseBegin(absl::Status status) {
  const std::lock_guard lock(mutex_);
  refuse_begin_ = std::move(status);
}

bool FakeSink::WaitFor(const std::function<bool(const std::vector<FakeSession>&)>& condition) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, std::chrono::seconds(30), [&] { return condition(sessions_); });
}

std::vector<FakeSession> FakeSink::Sessions() const {
  const std::lock_guard lock(mutex_);
  return sessions_;
}

std::string FakeSink::Joints(const FakeSession& session) {
  std::string text;
  for (const v1::Reading& reading : session.readings)
    text += (text.empty() ? "" : " ") + formats::FormatNumber(reading.joints_measured(0));
  return text;
}

v1::Nominal TwoJoints() {
  v1::Nominal nominal;
  for (int i = 0; i < 2; ++i) nominal.add_joints()->set_type(v1::REVOLUTE);
  return nominal;
}

}  // namespace truepose::agent
