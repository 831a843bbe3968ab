// What the bindings share.
#pragma once

#include "server/rpc/unary.h"
#include "server/services/bindings/bindings.h"

namespace truepose::services {

std::unique_ptr<grpc::Service> BindRobotService(const CallContext& call,
                                                const Executors& executors);
std::unique_ptr<grpc::Service> BindSessionService(const CallContext& call,
                                                  const Executors& executors, rpc::Drain& drain);
std::unique_ptr<grpc::Service> BindCalibrationService(const CallContext& call,
                                                      const Executors& executors,
                                                      rpc::Drain& drain);

}  // namespace truepose::services

// Overrides an RPC of the generated class by the handler of the same name, run on `executor`.
#define TRUEPOSE_BIND(Method, Request, Response, executor)                                        \
  grpc::ServerUnaryReactor* Method(grpc::CallbackServerContext* context,                          \
                                   const v1::Request* request, v1::Response* response) override { \
    return rpc::RunUnary(#Method, context, executor, response,                                    \
                         [this, request] { return services::Method(call_, *request); });          \
  }
