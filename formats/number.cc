#include "formats/number.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace truepose::formats {

std::optional<double> ParseNumber(std::string_view cell, bool decimal_comma) {
  std::string with_point;
  if (decimal_comma && cell.find(',') != std::string_view::npos) {
    // "1.234,5" may be a thousand or one and a bit: no number.
    if (cell.find('.') != std::string_view::npos) return std::nullopt;
    with_point = cell;
    std::replace(with_point.begin(), with_point.end(), ',', '.');
    cell = with_point;
  }
  if (cell.size() > 1 && cell[0] == '+' && cell[1] != '-') cell.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

std::string FormatNumber(double value) {
  char text[32];
  const auto [end, error] = std::to_chars(text, text + sizeof(text), value);
  return std::string(text, end);
}

}  // namespace truepose::formats
