// Whether two paths lead to one file.
#pragma once

#include <string>

#include "absl/status/status.h"

namespace truepose::cli {

// A fault of `option` when `output` is `input` itself: by the same path, another path, a symbolic
// link or a hard link. OK when there is no such file yet.
absl::Status CheckOtherFile(const std::string& input, const std::string& output,
                            const std::string& option);

}  // namespace truepose::cli
