// How a command ended: what people, programs and the shell are told.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/strings/string_view.h"
#include "client/cli/console.h"
#include "core/base/fault.h"

namespace truepose::cli {

// The command line itself is wrong; exit code 2.
absl::Status UsageError(absl::string_view message);

// A value of an option is wrong; exit code 3.
absl::Status OptionFault(absl::string_view option, absl::string_view found,
                         absl::string_view expected);

// The status of reading a file named on the command line: a file that is not there is a fault of
// the input, not an unknown resource.
absl::Status AsInputFault(const absl::Status& status);

// `hint` on a line of its own after the message when the status has that code; faults are kept.
// What was not found keeps the first hint it got: the innermost call knows best what was asked for.
absl::Status WithHint(const absl::Status& status, absl::StatusCode code, absl::string_view hint);

// Faults name fields of messages; people typed options. Replaces the beginning of each field by the
// first pair that fits, such as {"options.split", "--split"}; a status without faults stays as it
// is, and so does the hint of what was not found.
using Renaming = std::vector<std::pair<std::string, std::string>>;
absl::Status RenameFields(const absl::Status& status, const Renaming& renaming);

// Other faults under the code and the hint of `status`.
absl::Status WithFaults(const absl::Status& status, const FaultList& faults);

// client/exit_codes.h.
int ExitCodeOf(const absl::Status& status);

// A run that ended without success although its result is complete and already printed: exit code
// 1, and with `json` no second object.
absl::Status AnsweredFailure(absl::string_view message);

// Faults of the readings that a run found out (kFailedPrecondition) are faults of the input.
absl::Status AsFaultOfInput(const absl::Status& status);

// The message on `err`, one line a fault, with "truepose: " before it; with `json` also one object
// on `out`. Nothing for OK.
void PrintError(const Console& console, bool json, const absl::Status& status);

}  // namespace truepose::cli
