// A stream of requests, each answered before the next is read: what is acknowledged was handled
// whole.
#pragma once

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

// read -> handle on the executor -> write the reply -> read... Ends with OK when the client has
// said all, and with the handler's status at the first request that fails. Flow control of gRPC
// slows a client that is faster than us.
template <typename Request, typename Response>
class AckStream final : public grpc::ServerBidiReactor<Request, Response>, public Endable {
 public:
  using Handler = std::function<absl::StatusOr<Response>(const Request&)>;

  // The stream keeps itself alive until gRPC is done with it. The executor outlives it.
  static std::shared_ptr<AckStream> Make(Executor& executor, Call call, Handler handler) {
    std::shared_ptr<AckStream> stream(new AckStream(executor, std::move(call), std::move(handler)));
    stream->self_ = stream;
    stream->StartRead(&stream->request_);
    return stream;
  }

  void OnReadDone(bool ok) override {
    if (!ok) return End(absl::OkStatus());
    {
      std::lock_guard lock(mutex_);
      if (end_.has_value()) return;  // was finished while it waited
      state_ = State::kHandling;
    }
    if (!executor_.Submit([self = self_] { self->Handle(); })) Answer(TooBusy());
  }

  void OnWriteDone(bool ok) override {
    if (!ok) End(absl::CancelledError("the client left"));
    {
      std::lock_guard lock(mutex_);
      state_ = State::kReading;
      if (!end_.has_value()) {
        this->StartRead(&request_);
        return;
      }
    }
    this->Finish(Conclude(call_, *end_));
  }

  // A batch that is being handled is still acknowledged.
  void End(const absl::Status& status) override {
    {
      std::lock_guard lock(mutex_);
      if (end_.has_value()) return;
      end_ = status;
      if (state_ != State::kReading) return;
    }
    this->Finish(Conclude(call_, *end_));
  }

  void OnDone() override { std::shared_ptr<AckStream>(std::move(self_)); }

 private:
  enum class State { kReading, kHandling, kWriting };

  AckStream(Executor& executor, Call call, Handler handler)
      : executor_(executor), call_(std::move(call)), handler_(std::move(handler)) {}

  void Handle() {
    Answer(Guarded([this] { return handler_(request_); }));
  }

  void Answer(absl::StatusOr<Response> reply) {
    {
      std::lock_guard lock(mutex_);
      state_ = reply.ok() ? State::kWriting : State::kReading;
      if (!reply.ok()) end_ = reply.status();
    }
    if (!reply.ok()) return this->Finish(Conclude(call_, reply.status()));
    response_ = *std::move(reply);
    this->StartWrite(&response_);
  }

  Executor& executor_;
  const Call call_;
  const Handler handler_;
  Request request_;
  Response response_;
  std::mutex mutex_;
  // Of the three, kReading is the one in which the stream may be finished from outside.
  State state_ = State::kReading;
  std::optional<absl::Status> end_;
  std::shared_ptr<AckStream> self_;
};

}  // namespace truepose::rpc
