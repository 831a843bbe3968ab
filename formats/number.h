// Numbers as text, without any locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace truepose::formats {

// A whole cell as a finite number; nullopt for anything else, `nan`, `inf` and an empty cell
// included.
// @param decimal_comma also takes `1,5`; a text with both comma and point is then no number.
std::optional<double> ParseNumber(std::string_view cell, bool decimal_comma = false);

// The shortest text that reads back as the same bits.
std::string FormatNumber(double value);

}  // namespace truepose::formats
