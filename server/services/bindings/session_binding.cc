#include "server/rpc/ack_stream.h"
#include "server/services/append.h"
#include "server/services/bindings/binding.h"
#include "server/services/sessions.h"
#include "truepose/v1/services.grpc.pb.h"

namespace truepose::services {
namespace {

// A stream of uploads, as the adapter sees it.
class Appender final
    : public rpc::AckHandler<v1::AppendReadingsRequest, v1::AppendReadingsResponse> {
 public:
  explicit Appender(const CallContext& call) : call_(call), stream_(call) {}
  bool IsQuick(const v1::AppendReadingsRequest& request) const override {
    return stream_.IsQuick(request);
  }
  void Begin(const v1::AppendReadingsRequest& request, Done done) override {
    const absl::Status admitted = Recheck(call_);
    if (!admitted.ok()) return done(admitted);
    stream_.Append(request, std::move(done));
  }

 private:
  const CallContext call_;
  AppendStream stream_;
};

// The stream of who was not admitted: nothing of it gets anywhere.
class Refuser final
    : public rpc::AckHandler<v1::AppendReadingsRequest, v1::AppendReadingsResponse> {
 public:
  explicit Refuser(const absl::Status& status) : status_(status) {}
  bool IsQuick(const v1::AppendReadingsRequest&) const override { return true; }
  void Begin(const v1::AppendReadingsRequest&, Done done) override { done(status_); }

 private:
  const absl::Status status_;
};

class SessionBinding final : public v1::SessionService::CallbackService {
 public:
  SessionBinding(const CallContext& call, const Executors& executors, rpc::Drain& drain)
      : call_(call), handlers_(executors.handlers), drain_(drain) {}

  TRUEPOSE_BIND(CreateSession, CreateSessionRequest, Session, handlers_)
  TRUEPOSE_BIND(UpdateSession, UpdateSessionRequest, Session, handlers_)
  TRUEPOSE_BIND(DeleteSession, DeleteSessionRequest, Session, handlers_)
  TRUEPOSE_BIND(UndeleteSession, UndeleteSessionRequest, Session, handlers_)
  TRUEPOSE_BIND(GetSession, GetSessionRequest, Session, handlers_)
  TRUEPOSE_BIND(ListSessions, ListSessionsRequest, ListSessionsResponse, handlers_)
  TRUEPOSE_BIND(SealSession, SealSessionRequest, Session, handlers_)
  TRUEPOSE_BIND(ListReadings, ListReadingsRequest, ListReadingsResponse, handlers_)

  grpc::ServerBidiReactor<v1::AppendReadingsRequest, v1::AppendReadingsResponse>* AppendReadings(
      grpc::CallbackServerContext* context) override {
    using Stream = rpc::AckStream<v1::AppendReadingsRequest, v1::AppendReadingsResponse>;
    static const auto access = auth::AccessTo("AppendReadings");
    const absl::StatusOr<CallContext> call = Admit(call_, access, *context);
    std::unique_ptr<Stream::Handler> handler;
    if (call.ok()) handler = std::make_unique<Appender>(*call);
    if (!call.ok()) handler = std::make_unique<Refuser>(call.status());
    const auto stream =
        Stream::Make(handlers_, rpc::MakeCall("AppendReadings", *context), std::move(handler));
    drain_.Add(stream);
    if (!call.ok()) stream->End(call.status());
    return stream.get();
  }

 private:
  const CallContext call_;
  rpc::Executor& handlers_;
  rpc::Drain& drain_;
};

}  // namespace

std::unique_ptr<grpc::Service> BindSessionService(const CallContext& call,
                                                  const Executors& executors, rpc::Drain& drain) {
  return std::make_unique<SessionBinding>(call, executors, drain);
}

}  // namespace truepose::services
