// The one place where an absl::Status becomes what goes over the wire.
//
// code      the same number; it says what the caller should do.
// message   the status' message: one line a fault.
// details   google.rpc.Status with ErrorInfo{reason, domain "truepose"} and, for faults of the
// input,
//           BadRequest with a FieldViolation each: field, and as description "found X, expected Y".
//
// gRPC sends this as trailing metadata, and a receiver drops a call whose metadata exceed its own
// limit, 8 KiB unless it says otherwise. So the size is bounded: faults beyond the bound are
// counted in ErrorInfo.metadata["more_faults"]. A caller that takes more says so in the request
// metadata kErrorBytesKey.
#pragma once

#include <cstddef>
#include <string_view>

#include "absl/status/status.h"
#include "grpcpp/support/status.h"

namespace truepose::rpc {

inline constexpr char kErrorDomain[] = "truepose";
inline constexpr char kErrorBytesKey[] = "truepose-error-bytes";
inline constexpr size_t kDefaultErrorBytes = 6'000;
inline constexpr size_t kMostErrorBytes = 60'000;

// @param most_bytes of message and details together.
grpc::Status ToGrpcStatus(const absl::Status& status, size_t most_bytes = kDefaultErrorBytes);

// The bound that a caller asked for, at most kMostErrorBytes; the default when `text` is no such
// number.
size_t ErrorBytes(std::string_view text);

}  // namespace truepose::rpc
