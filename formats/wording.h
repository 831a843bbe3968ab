// How the faults of all formats speak.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/fault.h"

namespace truepose::formats {

// 'text' in single quotes, a long one cut between two characters.
std::string Quoted(std::string_view text);

// "a", "a or b", "a, b or c".
std::string AnyOf(const std::vector<std::string>& choices);

// The choice with the fewest letters to change, "" when none is near enough to be meant.
std::string Nearest(std::string_view word, const std::vector<std::string>& choices);

// A file of the wrong kind has a fault in every cell; only the first are shown (core/base/fault.h),
// so reading ends here instead of filling the memory.
bool IsEnough(const FaultList& faults);

}  // namespace truepose::formats
