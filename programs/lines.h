// Texts by their lines.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace truepose::programs {

// The lines of `text`, each with its end (LF, CRLF or CR): one after the other they are the text.
std::vector<std::string_view> LinesOf(std::string_view text);

// A line for people: without blanks at its ends and cut at 72 characters.
std::string Excerpt(std::string_view line);

// "3", "3, 7-9".
std::string LineNumbers(std::vector<int> lines);

}  // namespace truepose::programs
