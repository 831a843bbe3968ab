// What differs between a program and its corrected text, to read and for `patch`.
#pragma once

#include <string>
#include <string_view>

namespace truepose::programs {

// A unified diff with three lines of context; "" when nothing differs. The texts have the same
// number of lines (a correction never adds one): line i is compared with line i. Line ends are
// those of the texts, so that `patch --binary` makes the one from the other.
std::string UnifiedDiff(std::string_view before, std::string_view after,
                        std::string_view before_name, std::string_view after_name);

}  // namespace truepose::programs
