// What came over the wire becomes an absl::Status with the faults of the request.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "grpcpp/support/status.h"

namespace truepose::client {

// Request metadata that tells the server how many bytes of error details this client takes.
inline constexpr char kErrorBytesKey[] = "truepose-error-bytes";
inline constexpr char kErrorBytes[] = "60000";

// Same code; the message and the faults (core/base/fault.h) as the server had them. A call that was cut
// without a word of the server (kUnavailable, kCancelled) is kUnavailable and names `address`. Details that can't be
// read are left out: the code and message stand.
absl::Status FromGrpcStatus(const grpc::Status& status, const std::string& address);

}  // namespace truepose::client
