// Aligned tables of text for people.
#pragma once

#include <string>
#include <vector>

#include "absl/strings/string_view.h"

namespace truepose::cli {

enum class Align { kLeft, kRight };

struct Column {
  std::string title;
  Align align = Align::kRight;
};

// Columns are as wide as their widest cell and two blanks apart; lines end without blanks.
class Table {
 public:
  explicit Table(std::vector<Column> columns) : columns_(std::move(columns)) {}

  // Missing cells are empty; there may not be more cells than columns.
  void Add(std::vector<std::string> cells);

  bool empty() const { return rows_.empty(); }

  // Each line with `indent` before it; the titles first.
  std::string Text(absl::string_view indent = "") const;

 private:
  std::vector<size_t> Widths() const;
  std::string Line(const std::vector<std::string>& cells, const std::vector<size_t>& widths,
                   absl::string_view indent) const;

  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

// Characters of UTF-8 text, which a terminal shows one cell wide (no East Asian text in our
// tables).
size_t DisplayWidth(absl::string_view text);

// "0.497": `digits` after the point, no "-0.000".
std::string Fixed(double value, int digits);

// "30 rows", "1 row".
std::string Count(long long count, absl::string_view noun);

}  // namespace truepose::cli
