// Messages and errors as JSON, for programs and for files that are read back.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"
#include "google/protobuf/message.h"

namespace truepose::cli {

// The JSON of protobuf with the field names of the .proto files and all primitive fields, without a
// newline; 64-bit integers are strings there, doubles read back to the same bits. One line, or
// indented when `pretty`.
absl::StatusOr<std::string> ToJson(const google::protobuf::Message& message, bool pretty = false);

// Fills `message` from the text of a file. kInvalidArgument with a fault of `file_name` when it is
// not such JSON; `message` is then unspecified.
absl::Status FromJson(absl::string_view text, absl::string_view file_name,
                      google::protobuf::Message* message);

// {"error":{"code":"NOT_FOUND","message":"...","faults":[{"field","found","expected"}]}} without a
// newline.
std::string ErrorJson(const absl::Status& status);

// `text` quoted for JSON; bytes that are not UTF-8 become U+FFFD.
std::string JsonString(absl::string_view text);

}  // namespace truepose::cli
