// Text as it comes from disks and editors.
#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"

namespace truepose::formats {

// The bytes of a file (or of a pipe).
// @returns kNotFound, kPermissionDenied or kInvalidArgument (a folder; a read that fails; more than
// `most_bytes`)
//   with one fault that names the path.
absl::StatusOr<std::string> ReadTextFile(const std::string& path, size_t most_bytes);

// `text` without the byte order mark that some editors put in front of UTF-8.
std::string_view WithoutByteOrderMark(std::string_view text);

// Offset of the first byte that is no UTF-8 text (a NUL is none), or npos. Protobuf strings can
// hold nothing else.
size_t FindNotUtf8(std::string_view text);

// The last component of a path.
std::string_view BaseName(std::string_view path);

}  // namespace truepose::formats
