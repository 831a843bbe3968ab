// One request, a stream of replies of which only the latest matters: a slow reader skips values, it
// never queues them.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "absl/status/status.h"
#include "grpcpp/support/server_callback.h"
#include "server/rpc/call.h"
#include "server/rpc/drain.h"

namespace truepose::rpc {

// Push and End come from any thread and never wait. At most one write is under way; what is pushed
// meanwhile replaces what waits. End lets the value that waits go out first. gRPC is never called
// with the lock held.
template <typename Message>
class LatestStream final : public grpc::ServerWriteReactor<Message>, public Endable {
 public:
  // The stream keeps itself alive until gRPC is done with it.
  static std::shared_ptr<LatestStream> Make(Call call) {
    std::shared_ptr<LatestStream> stream(new LatestStream(std::move(call)));
    stream->self_ = stream;
    return stream;
  }

  void Push(const Message& message) {
    {
      std::lock_guard lock(mutex_);
      if (end_.has_value()) return;
      waiting_ = message;
    }
    Step();
  }

  void End(const absl::Status& status) override {
    {
      std::lock_guard lock(mutex_);
      if (end_.has_value()) return;
      end_ = status;
    }
    Step();
  }

  // Keeps what pushes alive until the stream is done; drops it at once when that is so already.
  void Hold(std::shared_ptr<void> source) {
    std::lock_guard lock(mutex_);
    if (!done_) std::swap(source_, source);
  }

  void OnWriteDone(bool ok) override {
    {
      std::lock_guard lock(mutex_);
      writing_ = false;
      if (!ok) Abandon();
    }
    Step();
  }

  void OnCancel() override {
    {
      std::lock_guard lock(mutex_);
      Abandon();
    }
    Step();
  }

  void OnDone() override {
    std::shared_ptr<void> source;
    std::shared_ptr<LatestStream> self;
    std::lock_guard lock(mutex_);
    done_ = true;
    std::swap(source, source_);
    std::swap(self, self_);
  }

 private:
  enum class Action { kNone, kWrite, kFinish };

  explicit LatestStream(Call call) : call_(std::move(call)) {}

  // The client is gone: nothing more goes out.
  void Abandon() {
    waiting_.reset();
    if (!end_.has_value()) end_ = absl::CancelledError("the client left");
  }

  Action Next() {
    std::lock_guard lock(mutex_);
    if (writing_ || finishing_) return Action::kNone;
    if (waiting_.has_value()) {
      writing_ = true;
      written_ = *std::exchange(waiting_, std::nullopt);
      return Action::kWrite;
    }
    if (!end_.has_value()) return Action::kNone;
    finishing_ = true;
    return Action::kFinish;
  }

  void Step() {
    const Action action = Next();
    if (action == Action::kWrite) this->StartWrite(&written_);
    if (action == Action::kFinish) this->Finish(Conclude(call_, *end_));
  }

  const Call call_;
  std::mutex mutex_;
  std::optional<Message> waiting_;
  Message written_;  // gRPC reads it while writing_
  std::optional<absl::Status> end_;
  bool writing_ = false, finishing_ = false, done_ = false;
  std::shared_ptr<void> source_;
  std::shared_ptr<LatestStream> self_;
};

}  // namespace truepose::rpc
