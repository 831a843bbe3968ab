// Where a caller's token comes from.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace truepose::client {

inline constexpr char kTokenVariable[] = "TRUEPOSE_TOKEN";
// Below the home folder.
inline constexpr char kTokenFile[] = ".config/truepose/token";

// The secret of the first of these that is given: the file `named` (--token-file; "" = none), the
// variable TRUEPOSE_TOKEN, the file ~/.config/truepose/token when it is there. "" = none, as for a
// server with --dev-open.
// @returns the faults of ReadTokenFile; kInvalidArgument with a fault of TRUEPOSE_TOKEN.
absl::StatusOr<std::string> FindToken(const std::string& named);

// The one line of a file that only its owner may read.
// @returns kInvalidArgument with a fault of `path`: can't be read, open to others, no secret in it.
// No fault has the content.
absl::StatusOr<std::string> ReadTokenFile(const std::string& path);

// What may be sent: 1 to 512 characters that can be seen. gRPC ends the process at others.
bool IsSecret(const std::string& text);

}  // namespace truepose::client
