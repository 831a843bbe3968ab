// One request, a stream of replies that are made when the connection takes another one: nothing is
// queued for a slow reader.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "grpcpp/server_context.h"
#include "grpcpp/support/server_callback.h"
#include "server/rpc/call.h"
#include "server/rpc/drain.h"
#include "server/rpc/executor.h"
#include "server/rpc/guard.h"

namespace truepose::rpc {

// What a stream sends. Both run on the executor or a thread of gRPC, never two at once.
template <typename Message>
struct PullSource {
  // The next message; nothing = none now, asked again after a Wake; an error ends the stream.
  std::function<absl::StatusOr<std::optional<Message>>()> next;
  // The status that ends the stream of a reader who was too slow.
  std::function<absl::Status()> too_slow;
};

// Wake, CheckStall and End come from any thread and never wait. A message that the connection has
// not taken within `stall` ends the stream; one that still waits after twice that time cancels the
// call, which frees its memory.
template <typename Message>
class PullStream final : public grpc::ServerWriteReactor<Message>, public Endable {
 public:
  // The stream keeps itself alive until gRPC is done with it. The context is the call's.
  static std::shared_ptr<PullStream> Make(grpc::CallbackServerContext* context, Call call,
                                          Executor& executor, absl::Duration stall) {
    std::shared_ptr<PullStream> stream(new PullStream(context, std::move(call), executor, stall));
    stream->self_ = stream;
    return stream;
  }

  // Call it once, before the first Wake. `held` lives as long as the stream sends.
  void Begin(PullSource<Message> source, std::shared_ptr<void> held) {
    std::lock_guard lock(mutex_);
    if (done_) return;
    source_ = std::move(source);
    held_ = std::move(held);
  }

  void Wake() {
    {
      std::lock_guard lock(mutex_);
      woken_ = true;
    }
    Step();
  }

  void CheckStall() {
    grpc::CallbackServerContext* context = nullptr;
    {
      std::lock_guard lock(mutex_);
      const bool stalled = writing_ && absl::Now() - write_begin_ > 2 * stall_;
      if (stalled && !done_) context = context_;
    }
    if (context != nullptr) context->TryCancel();
    Step();  // an executor that was too busy is asked again
  }

  void End(const absl::Status& status) override {
    {
      std::lock_guard lock(mutex_);
      if (end_.has_value()) return;
      end_ = status;
    }
    Step();
  }

  void OnWriteDone(bool ok) override {
    {
      std::lock_guard lock(mutex_);
      writing_ = false;
      woken_ = true;
      if (!ok && !end_.has_value()) end_ = absl::CancelledError("the client left");
      const bool slow = absl::Now() - write_begin_ > stall_;
      if (slow && !end_.has_value()) end_ = source_.too_slow();
    }
    Step();
  }

  void OnCancel() override { End(absl::CancelledError("the client left")); }

  void OnDone() override {
    std::shared_ptr<void> held;
    std::shared_ptr<PullStream> self;
    PullSource<Message> source;
    std::lock_guard lock(mutex_);
    done_ = true;
    std::swap(source, source_);
    std::swap(held, held_);
    std::swap(self, self_);
  }

 private:
  enum class Action { kNone, kPull, kFinish };

  PullStream(grpc::CallbackServerContext* context, Call call, Executor& executor,
             absl::Duration stall)
      : context_(context), call_(std::move(call)), executor_(executor), stall_(stall) {}

  Action Next() {
    std::lock_guard lock(mutex_);
    if (writing_ || pulling_ || finishing_) return Action::kNone;
    if (end_.has_value()) {
      finishing_ = true;
      return Action::kFinish;
    }
    if (!woken_ || !source_.next) return Action::kNone;
    woken_ = false;
    pulling_ = true;
    return Action::kPull;
  }

  void Step() {
    const Action action = Next();
    if (action == Action::kFinish) this->Finish(Conclude(call_, *end_));
    if (action != Action::kPull) return;
    if (executor_.Submit([self = self_] { self->Pull(); })) return;
    std::lock_guard lock(mutex_);
    pulling_ = false;
    woken_ = true;  // the next CheckStall tries again
  }

  void Pull() {
    absl::StatusOr<std::optional<Message>> next = Guarded(source_.next);
    bool write = false;
    {
      std::lock_guard lock(mutex_);
      pulling_ = false;
      if (!next.ok() && !end_.has_value()) end_ = next.status();
      write = next.ok() && next->has_value() && !end_.has_value();
      if (write) {
        written_ = *std::move(*next);
        writing_ = true;
        write_begin_ = absl::Now();
      }
    }
    if (write) return this->StartWrite(&written_);
    Step();
  }

  grpc::CallbackServerContext* const context_;
  const Call call_;
  Executor& executor_;
  const absl::Duration stall_;
  std::mutex mutex_;
  PullSource<Message> source_;
  Message written_;  // gRPC reads it while writing_
  absl::Time write_begin_;
  std::optional<absl::Status> end_;
  bool woken_ = false, pulling_ = false, writing_ = false, finishing_ = false, done_ = false;
  std::shared_ptr<void> held_;
  std::shared_ptr<PullStream> self_;
};

}  // namespace truepose::rpc
