// What differs between a program and its corrected text, to read and for `patch`.
#pragma once

#include <string>
#include <string_view>

namespace truepose::programs {

// A unified diff with three lines of context; "" when nothing differs. Line i is compared with line
// i, for a correction changes lines where they stand; only `added_line` of `after` (counted from 1,
// 0 = none) is new. Line ends are those of the texts, so that `patch --binary` makes the one from
// the other.
std::string UnifiedDiff(std::string_view before, std::string_view after,
                        std::string_view before_name, std::string_view after_name,
                        int added_line = 0);

}  // namespace truepose::programs
