#include "programs/lines.h"

#include <algorithm>

#include "formats/strings.h"

namespace truepose::programs {
namespace {

constexpr size_t kLongestExcerpt = 72;

size_t EndOfLine(std::string_view text, size_t begin) {
  const size_t end = text.find_first_of("\r\n", begin);
  if (end == std::string_view::npos) return text.size();
  return end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
}

bool ContinuesCharacter(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

}  // namespace

std::vector<std::string_view> LinesOf(std::string_view text) {
  std::vector<std::string_view> lines;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = EndOfLine(text, begin);
    lines.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return lines;
}

std::string Excerpt(std::string_view line) {
  const size_t begin = line.find_first_not_of(" \t\r\n");
  if (begin == std::string_view::npos) return "";
  line = line.substr(begin, line.find_last_not_of(" \t\r\n") + 1 - begin);
  if (line.size() <= kLongestExcerpt) return std::string(line);
  size_t size = kLongestExcerpt;
  while (size > 0 && ContinuesCharacter(line[size])) --size;
  return formats::StrCat(line.substr(0, size), "...");
}

std::string LineNumbers(std::vector<int> lines) {
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  std::string text;
  for (size_t i = 0; i < lines.size();) {
    size_t last = i;
    while (last + 1 < lines.size() && lines[last + 1] == lines[last] + 1) ++last;
    formats::StrAppend(&text, text.empty() ? "" : ", ", lines[i]);
    if (last > i) formats::StrAppend(&text, last == i + 1 ? ", " : "-", lines[last]);
    i = last + 1;
  }
  return text;
}

}  // namespace truepose::programs
