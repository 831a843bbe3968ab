// What the adapters know of a call beside its messages, and how they end it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "grpcpp/server_context.h"
#include "grpcpp/support/status.h"

namespace truepose::rpc {

struct Call {
  std::string method;
  size_t error_bytes = 0;  // status.h
  absl::Time begin;
};

// Reads the metadata of a call that begins now.
Call MakeCall(const char* method, const grpc::CallbackServerContext& context);

// The first value of the call's metadata `key`, "" when there is none. It lives as long as the
// context.
std::string_view MetadataOf(const grpc::CallbackServerContext& context, const char* key);

// Turns the call's status into gRPC's, and logs it: what is the server's own fault as an error, the
// rest for debugging.
grpc::Status Conclude(const Call& call, const absl::Status& status);

}  // namespace truepose::rpc
