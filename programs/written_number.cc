#include "programs/written_number.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "absl/strings/str_format.h"

namespace truepose::programs {
namespace {

constexpr int kMostDecimals = 10;  // 0.1 nm at a metre

int DecimalsOf(std::string_view number) {
  const size_t point = number.find('.');
  if (point == std::string_view::npos) return 0;
  const size_t end = std::min(number.find_first_not_of("0123456789", point + 1), number.size());
  return static_cast<int>(std::min<size_t>(end - point - 1, kMostDecimals));
}

int Decimals(Unit unit, std::string_view as_written) {
  return std::max(unit == Unit::kRadOrM ? 8 : 6, DecimalsOf(as_written));
}

}  // namespace

double SiPerUnit(Unit unit, bool prismatic) {
  if (unit == Unit::kRadOrM) return 1.0;
  if (!prismatic) return std::numbers::pi / 180.0;
  return unit == Unit::kDegOrMm ? 1e-3 : 0.0;
}

std::string WriteNumber(double value, Unit unit, std::string_view as_written, bool after_name) {
  const double precision = PrintedPrecision(unit, as_written);
  if (std::abs(value) < precision) value = 0.0;
  const bool plus = as_written.starts_with('+') || after_name;
  return absl::StrFormat("%s%.*f", plus && value >= 0.0 ? "+" : "", Decimals(unit, as_written),
                         value);
}

double PrintedPrecision(Unit unit, std::string_view as_written) {
  return 0.5 * std::pow(10.0, -Decimals(unit, as_written));
}

}  // namespace truepose::programs
