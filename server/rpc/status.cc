#include "server/rpc/status.h"

#include <algorithm>
#include <string>
#include <utility>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "core/base/error_metadata.h"
#include "core/base/fault.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"

namespace truepose::rpc {
namespace {

// What Any, ErrorInfo and the outer message cost beside their contents.
constexpr size_t kFrameBytes = 300;

std::string Description(const Fault& fault) {
  if (fault.expected.empty()) return fault.found;
  return absl::StrCat("found ", fault.found, ", expected ", fault.expected);
}

// A cut in the middle of a UTF-8 character would make the message unprintable.
std::string Shorten(const std::string& text, size_t most) {
  if (text.size() <= most) return text;
  size_t end = most > 3 ? most - 3 : 0;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return absl::StrCat(text.substr(0, end), "...");
}

// @returns how many faults had no room.
int AddViolations(const std::vector<Fault>& faults, size_t most_bytes,
                  google::rpc::BadRequest* out) {
  size_t used = 0;
  int left_out = 0;
  for (const Fault& fault : faults) {
    google::rpc::BadRequest::FieldViolation violation;
    violation.set_field(fault.field);
    violation.set_description(Description(fault));
    used += violation.ByteSizeLong() + 4;
    if (used > most_bytes) {
      ++left_out;
    } else {
      *out->add_field_violations() = std::move(violation);
    }
  }
  return left_out;
}

std::string Details(const absl::Status& status, const std::string& message, size_t most_bytes) {
  google::rpc::BadRequest bad_request;
  const int left_out = AddViolations(FaultsOf(status), most_bytes, &bad_request);
  google::rpc::ErrorInfo info;
  info.set_reason(absl::StatusCodeToString(status.code()));
  info.set_domain(kErrorDomain);
  for (const auto& [name, value] : ErrorMetadataOf(status))
    (*info.mutable_metadata())[name] = value;
  if (left_out > 0) (*info.mutable_metadata())["more_faults"] = absl::StrCat(left_out);
  google::rpc::Status details;
  details.set_code(static_cast<int>(status.code()));
  // Readers of details alone get the first lines; the whole message travels beside.
  details.set_message(Shorten(message, 100));
  details.add_details()->PackFrom(info);
  if (bad_request.field_violations_size() > 0) details.add_details()->PackFrom(bad_request);
  return details.SerializeAsString();
}

}  // namespace

grpc::Status ToGrpcStatus(const absl::Status& status, size_t most_bytes) {
  if (status.ok()) return grpc::Status::OK;
  const size_t room = most_bytes > kFrameBytes ? most_bytes - kFrameBytes : 0;
  const std::string message = Shorten(std::string(status.message()), room / 2);
  return grpc::Status(static_cast<grpc::StatusCode>(status.code()), message,
                      Details(status, message, room - std::min(room, message.size())));
}

size_t ErrorBytes(std::string_view text) {
  size_t bytes = 0;
  if (!absl::SimpleAtoi(std::string(text), &bytes)) return kDefaultErrorBytes;
  return std::clamp(bytes, kDefaultErrorBytes, kMostErrorBytes);
}

}  // namespace truepose::rpc
