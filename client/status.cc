#include "client/status.h"

#include <string_view>
#include <utility>

#include "absl/strings/cord.h"
#include "absl/strings/str_cat.h"
#include "core/base/error_metadata.h"
#include "core/base/fault.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace truepose::client {
namespace {

constexpr std::string_view kFound = "found ";
constexpr std::string_view kExpected = ", expected ";

// The reverse of how the server writes a description; ToString(fault) is the same line either way.
Fault ToFault(const google::rpc::BadRequest::FieldViolation& violation) {
  std::string_view text = violation.description();
  const size_t split = text.find(kExpected);
  if (!text.starts_with(kFound) || split == std::string_view::npos) {
    return {violation.field(), std::string(text), ""};
  }
  return {violation.field(), std::string(text.substr(kFound.size(), split - kFound.size())),
          std::string(text.substr(split + kExpected.size()))};
}

struct Details {
  bool from_truepose = false;
  FaultList faults;
  ErrorMetadata metadata;
};

Details ReadDetails(const grpc::Status& status) {
  Details out;
  google::rpc::Status details;
  if (!details.ParseFromString(status.error_details())) return out;
  for (const google::protobuf::Any& any : details.details()) {
    google::rpc::ErrorInfo info;
    google::rpc::BadRequest bad_request;
    if (any.UnpackTo(&info)) {
      out.from_truepose = info.domain() == "truepose";
      out.metadata.insert(info.metadata().begin(), info.metadata().end());
    } else if (any.UnpackTo(&bad_request)) {
      for (const auto& violation : bad_request.field_violations())
        out.faults.Add(ToFault(violation));
    }
  }
  return out;
}

// Keeps the server's message, which may count faults that were not sent, and adds the faults as
// core/base carries them.
absl::Status WithDetails(absl::Status status, const Details& details) {
  for (const auto& [name, value] : details.metadata) {
    status = WithErrorMetadata(std::move(status), name, value);
  }
  details.faults.ToStatus(status.code())
      .ForEachPayload([&](absl::string_view type, const absl::Cord& payload) {
        status.SetPayload(type, payload);
      });
  return status;
}

}  // namespace

absl::Status FromGrpcStatus(const grpc::Status& status, const std::string& address) {
  if (status.ok()) return absl::OkStatus();
  const auto code = static_cast<absl::StatusCode>(status.error_code());
  const Details details = ReadDetails(status);
  // A server that goes away resets its calls, which gRPC calls cancelled; what we cancel ourselves
  // never gets here.
  const bool cut = code == absl::StatusCode::kUnavailable || code == absl::StatusCode::kCancelled;
  if (cut && !details.from_truepose) {
    return absl::UnavailableError(
        absl::StrCat("no Truepose server answers at ", address, " (", status.error_message(), ")"));
  }
  return WithDetails(absl::Status(code, status.error_message()), details);
}

}  // namespace truepose::client
