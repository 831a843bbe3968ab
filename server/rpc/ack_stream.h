// A stream of requests, each answered in its order: what is acknowledged was handled whole.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "absl/status/statusor.h"
#include "grpcpp/support/server_callback.h"
#include "server/rpc/call.h"
#include "server/rpc/drain.h"
#include "server/rpc/executor.h"
#include "server/rpc/guard.h"

namespace truepose::rpc {

// What is done with the requests of one stream. Its calls come one at a time.
template <typename Request, typename Response>
class AckHandler {
 public:
  using Done = std::function<void(absl::StatusOr<Response>)>;

  virtual ~AckHandler() = default;
  // Whether Begin neither waits nor computes for long. It runs in gRPC's own thread then.
  virtual bool IsQuick(const Request& request) const = 0;
  // Takes what it needs of the request, which is gone after this, and calls `done` once, now or
  // later, from any thread. It may be called again before that.
  virtual void Begin(const Request& request, Done done) = 0;
};

// read -> begin -> answer; a few requests are read ahead while earlier ones wait for their answers,
// which leave in the order of the requests. Ends with OK when the client has said all, and with the
// handler's status at the first request that fails: none is begun after that is known. Flow control
// of gRPC slows a client that is faster than us.
template <typename Request, typename Response>
class AckStream final : public grpc::ServerBidiReactor<Request, Response>, public Endable {
 public:
  using Handler = AckHandler<Request, Response>;
  using Function = std::function<absl::StatusOr<Response>(const Request&)>;

  // The stream keeps itself alive until gRPC is done with it. The executor outlives it.
  static std::shared_ptr<AckStream> Make(Executor& executor, Call call,
                                         std::unique_ptr<Handler> handler) {
    std::shared_ptr<AckStream> stream(new AckStream(executor, std::move(call), std::move(handler)));
    stream->self_ = stream;
    stream->Proceed();
    return stream;
  }
  // For work that is done when `function` returns; it always runs on the executor.
  static std::shared_ptr<AckStream> Make(Executor& executor, Call call, Function function) {
    return Make(executor, std::move(call), std::make_unique<Waiting>(std::move(function)));
  }

  void OnReadDone(bool ok) override {
    const std::optional<size_t> slot = Accept(ok);
    if (!slot.has_value()) return Proceed();
    if (handler_->IsQuick(request_)) return Handle(*slot);
    if (executor_.Submit([self = self_, slot] { self->Handle(*slot); })) return;
    Answer(*slot, TooBusy());
    EndHandling();
  }

  void OnWriteDone(bool ok) override {
    {
      std::lock_guard lock(mutex_);
      writing_ = false;
      if (!ok) Abandon(absl::CancelledError("the client left"));
    }
    Proceed();
  }

  // What was begun is still acknowledged.
  void End(const absl::Status& status) override {
    {
      std::lock_guard lock(mutex_);
      if (!end_.has_value()) end_ = status;
    }
    Proceed();
  }

  void OnDone() override { std::shared_ptr<AckStream>(std::move(self_)); }

 private:
  // Requests that may wait for their answers, and their bytes; one may be larger than that alone.
  static constexpr size_t kMostAhead = 8;
  static constexpr size_t kMostBytesAhead = 1 << 20;

  class Waiting final : public Handler {
   public:
    explicit Waiting(Function function) : function_(std::move(function)) {}
    bool IsQuick(const Request&) const override { return false; }
    void Begin(const Request& request, typename Handler::Done done) override {
      done(function_(request));
    }

   private:
    const Function function_;
  };

  struct Slot {
    size_t bytes = 0;
    std::optional<absl::StatusOr<Response>> answer;
  };

  AckStream(Executor& executor, Call call, std::unique_ptr<Handler> handler)
      : executor_(executor), call_(std::move(call)), handler_(std::move(handler)) {}

  // A place among the answers for the request that was just read; none when there is none, or when
  // the stream was ended while it waited.
  std::optional<size_t> Accept(bool ok) {
    const size_t bytes = ok ? request_.ByteSizeLong() : 0;
    std::lock_guard lock(mutex_);
    reading_ = false;
    if (!ok && !end_.has_value()) end_ = absl::OkStatus();
    if (end_.has_value()) return std::nullopt;
    handling_ = true;
    bytes_ahead_ += bytes;
    slots_.push_back({.bytes = bytes, .answer = std::nullopt});
    return first_slot_ + slots_.size() - 1;
  }

  void Handle(size_t slot) {
    const absl::Status status = Guarded([&]() -> absl::Status {
      handler_->Begin(request_, [self = self_, slot](absl::StatusOr<Response> answer) {
        self->Answer(slot, std::move(answer));
      });
      return absl::OkStatus();
    });
    if (!status.ok()) Answer(slot, status);
    EndHandling();
  }

  void EndHandling() {
    {
      std::lock_guard lock(mutex_);
      handling_ = false;
    }
    Proceed();
  }

  void Answer(size_t slot, absl::StatusOr<Response> answer) {
    {
      std::lock_guard lock(mutex_);
      // A stream that was given up has no slots any more.
      if (slot < first_slot_ || slot - first_slot_ >= slots_.size()) return;
      if (!answer.ok()) failed_ = true;
      slots_[slot - first_slot_].answer = std::move(answer);
    }
    Proceed();
  }

  // Does whatever can be done next. gRPC is called outside of the lock; the flags that were set
  // within it keep other threads from doing the same, and from finishing meanwhile.
  void Proceed() {
    for (Next next = Decide(); next != Next(); next = Decide()) {
      if (next.finish) return this->Finish(Conclude(call_, *end_));
      if (next.write) this->StartWrite(&response_);
      if (next.read) this->StartRead(&request_);
      std::lock_guard lock(mutex_);
      --starting_;
    }
  }

  struct Next {
    bool write = false, read = false, finish = false;
    bool operator==(const Next&) const = default;
  };

  Next Decide() {
    std::lock_guard lock(mutex_);
    if (finished_) return {};
    Next next;
    next.write = TakeAnswer();
    next.read = MayRead();
    reading_ = reading_ || next.read;
    if (next.write || next.read) {
      ++starting_;
    } else {
      finished_ = next.finish = end_.has_value() && IsIdle();
    }
    return next;
  }

  bool IsIdle() const { return slots_.empty() && !writing_ && !handling_ && starting_ == 0; }

  bool MayRead() const {
    return !reading_ && !handling_ && !failed_ && !end_.has_value() && slots_.size() < kMostAhead &&
           bytes_ahead_ < kMostBytesAhead;
  }

  // The first answer, if it is there, into response_. @returns whether it is to be written.
  bool TakeAnswer() {
    if (writing_ || slots_.empty() || !slots_.front().answer.has_value()) return false;
    if (!slots_.front().answer->ok()) {
      Abandon(slots_.front().answer->status());
      return false;
    }
    response_ = **std::move(slots_.front().answer);
    bytes_ahead_ -= slots_.front().bytes;
    slots_.pop_front();
    ++first_slot_;
    return writing_ = true;
  }

  // Nothing more is answered.
  void Abandon(const absl::Status& status) {
    end_ = status;
    first_slot_ += slots_.size();
    slots_.clear();
  }

  Executor& executor_;
  const Call call_;
  const std::unique_ptr<Handler> handler_;
  Request request_;    // while reading_ or handling_
  Response response_;  // while writing_
  std::mutex mutex_;   // of all below
  bool reading_ = false, handling_ = false, writing_ = false;
  int starting_ = 0;       // threads that call gRPC at the moment
  bool failed_ = false;    // a request that was begun
  bool finished_ = false;  // gRPC has been told
  std::optional<absl::Status> end_;
  std::deque<Slot> slots_;  // of the requests whose answers have not been written, in their order
  size_t first_slot_ = 0;   // number of slots_.front()
  size_t bytes_ahead_ = 0;
  std::shared_ptr<AckStream> self_;
};

}  // namespace truepose::rpc
