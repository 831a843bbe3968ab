// What the adapters read from a call's metadata.
#pragma once

#include <cstddef>

#include "grpcpp/server_context.h"
#include "server/rpc/status.h"

namespace truepose::rpc {

inline size_t ErrorBytesOf(const grpc::CallbackServerContext& context) {
  const auto& metadata = context.client_metadata();
  const auto found = metadata.find(kErrorBytesKey);
  if (found == metadata.end()) return kDefaultErrorBytes;
  return ErrorBytes({found->second.data(), found->second.size()});
}

}  // namespace truepose::rpc
