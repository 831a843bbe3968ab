// The door: every RPC of every service passes here before its handler, so that who calls and
// whether they may is decided in one place.
#pragma once

#include <optional>
#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "grpcpp/server_context.h"
#include "server/auth/access_table.h"
#include "server/rpc/unary.h"
#include "server/services/call_context.h"

namespace truepose::services {

// The context of one call: `call` with who calls, by its metadata `authorization`.
// @returns kUnauthenticated, kPermissionDenied; kInternal without an administration, so that
// nothing is open because somebody forgot it.
absl::StatusOr<CallContext> Admit(const CallContext& call,
                                  const std::optional<auth::Access>& access,
                                  const grpc::CallbackServerContext& context);

// For each message of a stream that was admitted: whether its token still holds.
absl::Status Recheck(const CallContext& admitted);

// Admits a call and runs `handle`, which takes its context and returns absl::StatusOr<Response>.
// One that is refused is finished at once, and takes no place in the executor.
template <typename Response, typename Handle>
grpc::ServerUnaryReactor* RunAdmitted(const CallContext& call,
                                      const std::optional<auth::Access>& access, const char* method,
                                      grpc::CallbackServerContext* context, rpc::Executor& executor,
                                      Response* response, Handle handle) {
  absl::StatusOr<CallContext> admitted = Admit(call, access, *context);
  if (!admitted.ok()) return rpc::RefuseUnary(method, context, admitted.status());
  return rpc::RunUnary(
      method, context, executor, response,
      [admitted = *std::move(admitted), handle = std::move(handle)] { return handle(admitted); });
}

}  // namespace truepose::services
