// What a session without any usable reading would have needed.
#pragma once

#include <vector>

#include "absl/status/status.h"
#include "convert/run.h"

namespace truepose::convert {

// OK with any reading of a problem. Else kInvalidArgument with one fault of `sessions` that says
// which columns the rows would need under these options, and of which kind those are that were
// found.
// @param usable how many readings were found.
absl::Status CheckUsable(const std::vector<const v1::SessionInput*>& sessions,
                         const v1::CalibrationOptions& options, size_t usable);

}  // namespace truepose::convert
