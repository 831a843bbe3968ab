// How a command ended: what people, programs and the shell are told.
#pragma once

#include <string_view>

#include "absl/status/status.h"
#include "client/cli/console.h"

namespace truepose::cli {

// The command line itself is wrong; exit code 2.
absl::Status UsageError(std::string_view message);

// A value of an option is wrong; exit code 3.
absl::Status OptionFault(std::string_view option, std::string_view found, std::string_view expected);

// The status of reading a file named on the command line: a file that is not there is a fault of the input, not an
// unknown resource.
absl::Status AsInputFault(const absl::Status& status);

// `hint` on a line of its own after the message when the status has that code; faults are kept.
absl::Status WithHint(const absl::Status& status, absl::StatusCode code, std::string_view hint);

// client/exit_codes.h.
int ExitCodeOf(const absl::Status& status);

// The message on `err`, one line a fault, with "truepose: " before it; with `json` also one object on `out`.
// Nothing for OK.
void PrintError(const Console& console, bool json, const absl::Status& status);

}  // namespace truepose::cli
