#include "client/cli/table.h"

#include <algorithm>
#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/strip.h"

namespace truepose::cli {
namespace {

constexpr char kGap[] = "  ";

std::string Pad(const std::string& cell, size_t width, Align align) {
  const std::string blanks(width - std::min(width, DisplayWidth(cell)), ' ');
  return align == Align::kLeft ? cell + blanks : blanks + cell;
}

}  // namespace

void Table::Add(std::vector<std::string> cells) {
  cells.resize(columns_.size());
  rows_.push_back(std::move(cells));
}

std::vector<size_t> Table::Widths() const {
  std::vector<size_t> widths;
  for (const Column& column : columns_) widths.push_back(DisplayWidth(column.title));
  for (const auto& row : rows_) {
    for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], DisplayWidth(row[i]));
  }
  return widths;
}

std::string Table::Line(const std::vector<std::string>& cells, const std::vector<size_t>& widths,
                        absl::string_view indent) const {
  std::string line(indent);
  for (size_t i = 0; i < cells.size(); ++i) {
    absl::StrAppend(&line, i == 0 ? "" : kGap, Pad(cells[i], widths[i], columns_[i].align));
  }
  return absl::StrCat(absl::StripTrailingAsciiWhitespace(line), "\n");
}

std::string Table::Text(absl::string_view indent) const {
  const std::vector<size_t> widths = Widths();
  std::vector<std::string> titles;
  for (const Column& column : columns_) titles.push_back(column.title);
  std::string text = Line(titles, widths, indent);
  for (const auto& row : rows_) absl::StrAppend(&text, Line(row, widths, indent));
  return text;
}

size_t DisplayWidth(absl::string_view text) {
  // Continuation bytes of UTF-8 begin with the bits 10.
  return std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
}

std::string Fixed(double value, int digits) {
  const double half_step = 0.5 * std::pow(10.0, -digits);
  return absl::StrFormat("%.*f", digits, std::abs(value) < half_step ? 0.0 : value);
}

std::string Count(long long count, absl::string_view noun) {
  return absl::StrCat(count, " ", noun, count == 1 ? "" : "s");
}

}  // namespace truepose::cli
