#include "core/base/error_metadata.h"

#include <vector>

#include "absl/strings/cord.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"

namespace truepose {
namespace {

constexpr char kType[] = "type.truepose/error-metadata";

}  // namespace

absl::Status WithErrorMetadata(absl::Status status, const std::string& name,
                               const std::string& value) {
  ErrorMetadata metadata = ErrorMetadataOf(status);
  metadata[name] = value;
  std::string lines;
  for (const auto& [key, text] : metadata) absl::StrAppend(&lines, key, "=", text, "\n");
  status.SetPayload(kType, absl::Cord(lines));
  return status;
}

ErrorMetadata ErrorMetadataOf(const absl::Status& status) {
  ErrorMetadata metadata;
  const auto payload = status.GetPayload(kType);
  if (!payload.has_value()) return metadata;
  const std::string lines(*payload);
  const std::vector<std::string> parts = absl::StrSplit(lines, '\n', absl::SkipEmpty());
  for (const std::string& line : parts) {
    const size_t split = line.find('=');
    metadata[line.substr(0, split)] = line.substr(split + 1);
  }
  return metadata;
}

}  // namespace truepose
