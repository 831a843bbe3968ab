// What the bindings share.
#pragma once

#include "server/services/bindings/admission.h"
#include "server/services/bindings/bindings.h"

namespace truepose::services {

std::unique_ptr<grpc::Service> BindRobotService(const CallContext& call,
                                                const Executors& executors);
std::unique_ptr<grpc::Service> BindPlantService(const CallContext& call,
                                                const Executors& executors);
std::unique_ptr<grpc::Service> BindSessionService(const CallContext& call,
                                                  const Executors& executors, rpc::Drain& drain);
std::unique_ptr<grpc::Service> BindCalibrationService(const CallContext& call,
                                                      const Executors& executors,
                                                      rpc::Drain& drain);

std::unique_ptr<grpc::Service> BindCompensationTableService(const CallContext& call,
                                                            const Executors& executors);
std::unique_ptr<grpc::Service> BindRecalibrationService(const CallContext& call,
                                                        const Executors& executors);
std::unique_ptr<grpc::Service> BindDownloadService(const CallContext& call,
                                                   const Executors& executors, rpc::Drain& drain,
                                                   const WatchSettings& settings);

std::unique_ptr<grpc::Service> BindWatchService(const CallContext& call, const Executors& executors,
                                                rpc::Drain& drain, const WatchSettings& settings);
std::unique_ptr<grpc::Service> BindAdminService(const CallContext& call,
                                                const Executors& executors);

}  // namespace truepose::services

// Overrides an RPC of the generated class by the handler of the same name, run on `executor` for
// who was admitted.
#define TRUEPOSE_BIND(Method, Request, Response, executor)                                        \
  grpc::ServerUnaryReactor* Method(grpc::CallbackServerContext* context,                          \
                                   const v1::Request* request, v1::Response* response) override { \
    static const auto access = auth::AccessTo(#Method);                                           \
    return RunAdmitted(                                                                           \
        call_, access, #Method, context, executor, response,                                      \
        [request](const CallContext& call) { return services::Method(call, *request); });         \
  }

// The same for a standard method of a kind of resource: `function` is one of
// server/services/standard.h.
#define TRUEPOSE_BIND_STANDARD(Method, Response, function)                                     \
  grpc::ServerUnaryReactor* Method(grpc::CallbackServerContext* context,                       \
                                   const v1::Method##Request* request, v1::Response* response) \
      override {                                                                               \
    static const auto access = auth::AccessTo(#Method);                                        \
    return RunAdmitted(call_, access, #Method, context, handlers_, response,                   \
                       [request](const CallContext& call) -> absl::StatusOr<v1::Response> {    \
                         v1::Response made;                                                    \
                         const absl::Status status = function(call, *request, made);           \
                         if (!status.ok()) return status;                                      \
                         return made;                                                          \
                       });                                                                     \
  }

// All six of one kind.
#define TRUEPOSE_BIND_RESOURCE(Kind, Kinds)                                \
  TRUEPOSE_BIND_STANDARD(Create##Kind, Kind, CreateStandard)               \
  TRUEPOSE_BIND_STANDARD(Get##Kind, Kind, GetStandard)                     \
  TRUEPOSE_BIND_STANDARD(List##Kinds, List##Kinds##Response, ListStandard) \
  TRUEPOSE_BIND_STANDARD(Update##Kind, Kind, UpdateStandard)               \
  TRUEPOSE_BIND_STANDARD(Delete##Kind, Kind, DeleteStandard)               \
  TRUEPOSE_BIND_STANDARD(Undelete##Kind, Kind, UndeleteStandard)
