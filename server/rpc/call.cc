#include "server/rpc/call.h"

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "server/rpc/log.h"
#include "server/rpc/status.h"

namespace truepose::rpc {
namespace {

bool IsOurFault(const absl::Status& status) {
  return absl::IsInternal(status) || absl::IsDataLoss(status) || absl::IsUnknown(status);
}

}  // namespace

std::string_view MetadataOf(const grpc::CallbackServerContext& context, const char* key) {
  const auto found = context.client_metadata().find(key);
  if (found == context.client_metadata().end()) return {};
  return {found->second.data(), found->second.size()};
}

Call MakeCall(const char* method, const grpc::CallbackServerContext& context) {
  return {method, ErrorBytes(MetadataOf(context, kErrorBytesKey)), absl::Now()};
}

grpc::Status Conclude(const Call& call, const absl::Status& status) {
  if (IsOurFault(status)) {
    LogError(absl::StrCat(call.method, ": ", status.ToString()));
  } else {
    LogDebug(absl::StrCat(call.method, " ", absl::StatusCodeToString(status.code()), " after ",
                          absl::FormatDuration(absl::Now() - call.begin)));
  }
  return ToGrpcStatus(status, call.error_bytes);
}

}  // namespace truepose::rpc
