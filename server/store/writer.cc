#include "server/store/writer.h"

#include <algorithm>
#include <utility>

namespace truepose::store {

Writer::Writer(std::unique_ptr<sql::Connection> connection, const Clock& clock, int max_group)
    : connection_(std::move(connection)),
      clock_(clock),
      max_group_(static_cast<size_t>(max_group)),
      thread_([this] { Loop(); }) {}

Writer::~Writer() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  arrived_.notify_one();
  thread_.join();
}

absl::Status Writer::Write(std::function<absl::Status(Transaction&)> closure) {
  Waiting waiting;
  waiting.closure = std::move(closure);
  return Enqueue(waiting);
}

absl::Status Writer::Enqueue(Waiting& waiting) {
  std::unique_lock lock(mutex_);
  if (stopping_) return absl::CancelledError("the store is closing");
  queue_.push_back(&waiting);
  arrived_.notify_one();
  answered_.wait(lock, [&] { return waiting.done; });
  return waiting.result;
}

absl::Status Writer::WithConnection(const std::function<absl::Status(sql::Connection&)>& use) {
  const std::lock_guard lock(connection_mutex_);
  return use(*connection_);
}

void Writer::Loop() {
  for (std::vector<Waiting*> group = TakeGroup(); !group.empty(); group = TakeGroup()) {
    const std::vector<Work*> works(group.begin(), group.end());
    {
      const std::lock_guard lock(connection_mutex_);
      CommitGroup(*connection_, clock_, works);
    }
    Answer(group);
  }
}

// Empty means the end.
std::vector<Writer::Waiting*> Writer::TakeGroup() {
  std::unique_lock lock(mutex_);
  arrived_.wait(lock, [this] { return stopping_ || !queue_.empty(); });
  if (stopping_) {
    for (Waiting* waiting : queue_) {
      waiting->result = absl::CancelledError("the store is closing");
      waiting->done = true;
    }
    queue_.clear();
    answered_.notify_all();
    return {};
  }
  const auto end = queue_.begin() + std::min(queue_.size(), max_group_);
  std::vector<Waiting*> group(queue_.begin(), end);
  queue_.erase(queue_.begin(), end);
  return group;
}

void Writer::Answer(const std::vector<Waiting*>& group) {
  const std::lock_guard lock(mutex_);
  for (Waiting* waiting : group) waiting->done = true;
  answered_.notify_all();
}

}  // namespace truepose::store
