#include "programs/diff.h"

#include <algorithm>
#include <vector>

#include "formats/strings.h"
#include "programs/lines.h"

namespace truepose::programs {
namespace {

constexpr size_t kContext = 3;

// Lines [begin, end) of both texts.
struct Hunk {
  size_t begin, end;
};

class Differ {
 public:
  Differ(std::string_view before, std::string_view after)
      : before_(LinesOf(before)), after_(LinesOf(after)) {}

  std::vector<Hunk> Hunks() const {
    std::vector<Hunk> hunks;
    for (size_t i = 0; i < before_.size(); ++i) {
      if (before_[i] == after_[i]) continue;
      const size_t begin = i - std::min(i, kContext);
      const size_t end = std::min(i + kContext + 1, before_.size());
      if (hunks.empty() || begin > hunks.back().end) {
        hunks.push_back({begin, end});
      } else {
        hunks.back().end = end;
      }
    }
    return hunks;
  }

  std::string Text(const Hunk& hunk) const {
    const size_t count = hunk.end - hunk.begin;
    std::string text = formats::StrCat("@@ -", hunk.begin + 1, ",", count, " +", hunk.begin + 1,
                                       ",", count, " @@\n");
    for (size_t i = hunk.begin; i < hunk.end;) i = AppendBlock(i, hunk.end, &text);
    return text;
  }

 private:
  bool Same(size_t i) const { return before_[i] == after_[i]; }

  // One equal line, or all differing lines up to the next equal one.
  size_t AppendBlock(size_t i, size_t end, std::string* text) const {
    if (Same(i)) {
      Append(' ', before_[i], text);
      return i + 1;
    }
    size_t last = i;
    while (last < end && !Same(last)) ++last;
    for (size_t k = i; k < last; ++k) Append('-', before_[k], text);
    for (size_t k = i; k < last; ++k) Append('+', after_[k], text);
    return last;
  }

  static void Append(char mark, std::string_view line, std::string* text) {
    formats::StrAppend(text, std::string(1, mark), line);
    if (line.empty() || (line.back() != '\n' && line.back() != '\r'))
      formats::StrAppend(text, "\n\\ No newline at end of file\n");
  }

  const std::vector<std::string_view> before_, after_;
};

}  // namespace

std::string UnifiedDiff(std::string_view before, std::string_view after,
                        std::string_view before_name, std::string_view after_name) {
  const Differ differ(before, after);
  std::string text;
  for (const Hunk& hunk : differ.Hunks()) formats::StrAppend(&text, differ.Text(hunk));
  if (text.empty()) return text;
  return formats::StrCat("--- ", before_name, "\n+++ ", after_name, "\n", text);
}

}  // namespace truepose::programs
