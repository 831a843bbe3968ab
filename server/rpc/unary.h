// One request, one reply: a plain handler behind gRPC's callback API.
#pragma once

#include <utility>

#include "absl/status/statusor.h"
#include "grpcpp/server_context.h"
#include "server/rpc/call.h"
#include "server/rpc/executor.h"
#include "server/rpc/guard.h"

namespace truepose::rpc {

// Runs `handle`, which returns absl::StatusOr<Response>, on the executor and finishes the call with
// its result. Request and response of the call live until then. A call that its client has left
// already is not run.
template <typename Response, typename Handle>
grpc::ServerUnaryReactor* RunUnary(const char* method, grpc::CallbackServerContext* context,
                                   Executor& executor, Response* response, Handle handle) {
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  const Call call = MakeCall(method, *context);
  const bool accepted = executor.Submit([=] {
    if (context->IsCancelled()) return reactor->Finish(grpc::Status::CANCELLED);
    absl::StatusOr<Response> result = Guarded(handle);
    if (result.ok()) *response = *std::move(result);
    reactor->Finish(Conclude(call, result.status()));
  });
  if (!accepted) reactor->Finish(Conclude(call, TooBusy()));
  return reactor;
}

// Finishes a call before any handler.
inline grpc::ServerUnaryReactor* RefuseUnary(const char* method,
                                             grpc::CallbackServerContext* context,
                                             const absl::Status& status) {
  grpc::ServerUnaryReactor* reactor = context->DefaultReactor();
  reactor->Finish(Conclude(MakeCall(method, *context), status));
  return reactor;
}

}  // namespace truepose::rpc
