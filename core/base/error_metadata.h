// What a program, not a person, needs of an error: short names and values beside the message. They
// travel as google.rpc.ErrorInfo.metadata.
#pragma once

#include <map>
#include <string>

#include "absl/status/status.h"

namespace truepose {

// Names are lower_snake_case; neither a name nor a value has a line end in it, and a name no '='.
using ErrorMetadata = std::map<std::string, std::string>;

// `status` with one more entry; the same name again replaces the value. OK stays OK.
absl::Status WithErrorMetadata(absl::Status status, const std::string& name,
                               const std::string& value);

// Empty when `status` carries none.
ErrorMetadata ErrorMetadataOf(const absl::Status& status);

}  // namespace truepose
