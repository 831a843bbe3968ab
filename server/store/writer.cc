#include "server/store/writer.h"

#include <algorithm>
#include <utility>

namespace truepose::store {
namespace {

absl::Status Closing() { return absl::CancelledError("the store is closing"); }

}  // namespace

Writer::Writer(std::unique_ptr<sql::Connection> connection, const Clock& clock, int max_group)
    : connection_(std::move(connection)),
      clock_(clock),
      max_group_(static_cast<size_t>(max_group)),
      answer_thread_([this] { AnswerLoop(); }),
      thread_([this] { Loop(); }) {}

Writer::~Writer() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  arrived_.notify_one();
  thread_.join();
  {
    const std::lock_guard lock(answers_mutex_);
    answers_end_ = true;
  }
  answers_arrived_.notify_one();
  answer_thread_.join();
}

absl::Status Writer::Write(std::function<absl::Status(Transaction&)> closure) {
  const auto waiting = std::make_shared<Waiting>();
  waiting->closure = std::move(closure);
  if (!Enqueue(waiting)) return Closing();
  std::unique_lock lock(mutex_);
  answered_.wait(lock, [&] { return waiting->is_done; });
  return waiting->result;
}

void Writer::Submit(std::function<absl::Status(Transaction&)> closure,
                    std::function<void(const absl::Status&)> done) {
  const auto waiting = std::make_shared<Waiting>();
  waiting->closure = std::move(closure);
  waiting->done = std::move(done);
  if (!Enqueue(waiting)) waiting->done(Closing());
}

bool Writer::Enqueue(std::shared_ptr<Waiting> waiting) {
  const std::lock_guard lock(mutex_);
  if (stopping_) return false;
  queue_.push_back(std::move(waiting));
  // The thread looks at the queue again before it sleeps.
  if (queue_.size() == 1) arrived_.notify_one();
  return true;
}

absl::Status Writer::WithConnection(const std::function<absl::Status(sql::Connection&)>& use) {
  const std::lock_guard lock(connection_mutex_);
  return use(*connection_);
}

void Writer::Loop() {
  for (Group group = TakeGroup(); !group.empty(); group = TakeGroup()) {
    std::vector<Work*> works;
    for (const auto& waiting : group) works.push_back(waiting.get());
    {
      const std::lock_guard lock(connection_mutex_);
      CommitGroup(*connection_, clock_, works);
    }
    Answer(std::move(group));
  }
}

// Empty means the end.
Writer::Group Writer::TakeGroup() {
  std::unique_lock lock(mutex_);
  arrived_.wait(lock, [this] { return stopping_ || !queue_.empty(); });
  const auto end = stopping_ ? queue_.end() : queue_.begin() + std::min(queue_.size(), max_group_);
  Group group(queue_.begin(), end);
  queue_.erase(queue_.begin(), end);
  if (!stopping_) return group;
  lock.unlock();
  for (const auto& waiting : group) waiting->result = Closing();
  Answer(std::move(group));
  return {};
}

void Writer::Answer(Group group) {
  const auto asynchronous = std::stable_partition(
      group.begin(), group.end(), [](const auto& waiting) { return waiting->done == nullptr; });
  if (asynchronous != group.begin()) {
    const std::lock_guard lock(mutex_);
    for (auto one = group.begin(); one != asynchronous; ++one) (*one)->is_done = true;
    answered_.notify_all();
  }
  if (asynchronous == group.end()) return;
  const std::lock_guard lock(answers_mutex_);
  answers_.insert(answers_.end(), asynchronous, group.end());
  answers_arrived_.notify_one();
}

void Writer::AnswerLoop() {
  for (Group answers = TakeAnswers(); !answers.empty(); answers = TakeAnswers()) {
    for (auto& waiting : answers) {
      waiting->done(waiting->result);
      waiting = nullptr;
    }
  }
}

// Empty means the end.
Writer::Group Writer::TakeAnswers() {
  std::unique_lock lock(answers_mutex_);
  answers_arrived_.wait(lock, [this] { return answers_end_ || !answers_.empty(); });
  return std::exchange(answers_, {});
}

}  // namespace truepose::store
