// A caller who knows another state than the stored one is told so.
#pragma once

#include <string>

#include "absl/status/status.h"

namespace truepose::resource {

// @returns kAborted with a fault of `etag` when the caller knows another state; "" knows none.
// Quotes around it may be missing.
absl::Status CheckEtag(const std::string& stored, const std::string& asked);

}  // namespace truepose::resource
