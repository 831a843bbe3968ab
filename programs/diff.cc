#include "programs/diff.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "formats/strings.h"
#include "programs/lines.h"

namespace truepose::programs {
namespace {

constexpr size_t kContext = 3;

// A line of both texts; that before is missing where a line was added.
struct Row {
  std::optional<std::string_view> before;
  std::string_view after;

  bool is_same() const { return before == after; }
};

std::vector<Row> RowsOf(std::string_view before, std::string_view after, size_t added_line) {
  const std::vector<std::string_view> old = LinesOf(before);
  std::vector<Row> rows;
  for (const std::string_view line : LinesOf(after)) {
    const bool added = rows.size() + 1 == added_line;
    const size_t i = rows.size() - (added_line > 0 && rows.size() >= added_line ? 1 : 0);
    rows.push_back({added ? std::nullopt : std::optional(old[i]), line});
  }
  return rows;
}

// Rows [begin, end).
struct Hunk {
  size_t begin, end;
};

class Differ {
 public:
  explicit Differ(std::vector<Row> rows) : rows_(std::move(rows)) {}

  std::vector<Hunk> Hunks() const {
    std::vector<Hunk> hunks;
    for (size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i].is_same()) continue;
      const size_t begin = i - std::min(i, kContext);
      const size_t end = std::min(i + kContext + 1, rows_.size());
      if (hunks.empty() || begin > hunks.back().end) {
        hunks.push_back({begin, end});
      } else {
        hunks.back().end = end;
      }
    }
    return hunks;
  }

  std::string Text(const Hunk& hunk) const {
    const size_t added = Added(hunk.begin, hunk.end), count = hunk.end - hunk.begin;
    std::string text = formats::StrCat("@@ -", hunk.begin - Added(0, hunk.begin) + 1, ",",
                                       count - added, " +", hunk.begin + 1, ",", count, " @@\n");
    for (size_t i = hunk.begin; i < hunk.end;) i = AppendBlock(i, hunk.end, &text);
    return text;
  }

 private:
  size_t Added(size_t begin, size_t end) const {
    size_t added = 0;
    for (size_t i = begin; i < end; ++i) added += rows_[i].before.has_value() ? 0 : 1;
    return added;
  }

  // One equal line, or all differing lines up to the next equal one.
  size_t AppendBlock(size_t i, size_t end, std::string* text) const {
    if (rows_[i].is_same()) {
      Append(' ', rows_[i].after, text);
      return i + 1;
    }
    size_t last = i;
    while (last < end && !rows_[last].is_same()) ++last;
    for (size_t k = i; k < last; ++k)
      if (rows_[k].before.has_value()) Append('-', *rows_[k].before, text);
    for (size_t k = i; k < last; ++k) Append('+', rows_[k].after, text);
    return last;
  }

  static void Append(char mark, std::string_view line, std::string* text) {
    formats::StrAppend(text, std::string(1, mark), line);
    if (line.empty() || (line.back() != '\n' && line.back() != '\r'))
      formats::StrAppend(text, "\n\\ No newline at end of file\n");
  }

  const std::vector<Row> rows_;
};

}  // namespace

std::string UnifiedDiff(std::string_view before, std::string_view after,
                        std::string_view before_name, std::string_view after_name, int added_line) {
  const Differ differ(RowsOf(before, after, static_cast<size_t>(added_line)));
  std::string text;
  for (const Hunk& hunk : differ.Hunks()) formats::StrAppend(&text, differ.Text(hunk));
  if (text.empty()) return text;
  return formats::StrCat("--- ", before_name, "\n+++ ", after_name, "\n", text);
}

}  // namespace truepose::programs
