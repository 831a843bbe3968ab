#include "formats/unit.h"

#include <array>
#include <numbers>

#include "absl/strings/str_format.h"
#include "formats/number.h"
#include "formats/strings.h"

namespace truepose::formats {
namespace {

double Same(double value) { return value; }
double FromMillimetres(double mm) { return mm / 1000; }
// Divides first: 90, 45 and their like then give pi / 2, pi / 4 to the last bit.
double FromDegrees(double deg) { return deg / 180 * std::numbers::pi; }

// Of each dimension the one for people first.
constexpr std::array<Unit, 7> kUnits = {{
    {"deg", Dimension::kAngle, &FromDegrees},
    {"rad", Dimension::kAngle, &Same},
    {"mm", Dimension::kLength, &FromMillimetres},
    {"m", Dimension::kLength, &Same},
    {"C", Dimension::kTemperature, &Same},
    {"Nm", Dimension::kTorque, &Same},
    {"kg", Dimension::kMass, &Same},
}};

}  // namespace

const Unit* FindUnit(Dimension dimension, std::string_view symbol) {
  for (const Unit& unit : kUnits) {
    if (unit.dimension == dimension && unit.symbol == symbol) return &unit;
  }
  return nullptr;
}

std::vector<std::string> NamesWithUnits(std::string_view stem, Dimension dimension) {
  if (dimension == Dimension::kNone) return {std::string(stem)};
  std::vector<std::string> names;
  for (const Unit& unit : kUnits) {
    if (unit.dimension == dimension) names.push_back(StrCat(stem, "_", unit.symbol));
  }
  return names;
}

Measure MeasureForPeople(double si, Dimension dimension) {
  const bool angle = dimension == Dimension::kAngle;
  const Unit& unit = *FindUnit(dimension, angle ? "deg" : "mm");
  const double value = angle ? si / std::numbers::pi * 180 : si * 1000;
  std::string digits = absl::StrFormat("%.12g", value);
  const auto read = ParseNumber(digits);
  if (read.has_value() && unit.to_si(*read) == si) return {unit.symbol, std::move(digits)};
  return {angle ? "rad" : "m", FormatNumber(si)};
}

std::string EntryOfPosition(std::string_view stem, double x_m, double y_m, double z_m) {
  const std::array<double, 3> si = {x_m, y_m, z_m};
  std::array<Measure, 3> entries;
  bool all_mm = true;
  for (size_t i = 0; i < si.size(); ++i) {
    entries[i] = MeasureForPeople(si[i], Dimension::kLength);
    all_mm = all_mm && entries[i].symbol == "mm";
  }
  for (size_t i = 0; i < si.size() && !all_mm; ++i) entries[i].digits = FormatNumber(si[i]);
  return StrCat(stem, all_mm ? "_mm: [" : "_m: [", entries[0].digits, ", ", entries[1].digits, ", ",
                entries[2].digits, "]");
}

}  // namespace truepose::formats
