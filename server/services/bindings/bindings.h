// The generated service classes bound to the plain handlers: one line an RPC, nothing else.
#pragma once

#include <memory>
#include <vector>

#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "grpcpp/impl/codegen/service_type.h"
#include "server/rpc/drain.h"
#include "server/rpc/executor.h"
#include "server/services/call_context.h"
#include "server/watch/wake_hub.h"

namespace truepose::services {

// Where handlers run. They wait for the store, so they are more than the cores; what computes has
// threads of its own, so that a long evaluation never holds up an upload.
struct Executors {
  rpc::Executor& handlers;
  rpc::Executor& compute;
};

// Of watches and downloads.
struct WatchSettings {
  watch::WakeHub& hub;
  absl::Duration stall =
      absl::Seconds(20);  // a message that a reader has not taken by then ends its watch
  absl::Duration idle =
      absl::Seconds(15);  // a bookmark comes after this time without anything else
};

// All services of a server. What is referred to outlives them; `call` has an administration.
std::vector<std::unique_ptr<grpc::Service>> BindServices(const CallContext& call,
                                                         const Executors& executors,
                                                         rpc::Drain& drain,
                                                         const WatchSettings& watch);

}  // namespace truepose::services
