// Units that a column or key may name, and the way into m and rad.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace truepose::formats {

enum class Dimension { kNone, kAngle, kLength, kTemperature, kTorque, kMass };

struct Unit {
  std::string_view symbol;  // "mm"
  Dimension dimension;
  double (*to_si)(double);  // temperature stays in degrees Celsius
};

// nullptr when the dimension has no such unit.
const Unit* FindUnit(Dimension dimension, std::string_view symbol);

// `stem` with each unit of the dimension: {"x_mm", "x_m"}; the stem alone for kNone.
std::vector<std::string> NamesWithUnits(std::string_view stem, Dimension dimension);

// A value for people: symbol and digits.
struct Measure {
  std::string_view symbol;
  std::string digits;
};

// In mm or deg when at most 12 digits read back as the same bits, else in m or rad.
// @param dimension kLength or kAngle.
Measure MeasureForPeople(double si, Dimension dimension);

// "stem_mm: [1, 2, 3]" of lengths in m, in mm when that reads back as the same bits, else in m.
std::string EntryOfPosition(std::string_view stem, double x_m, double y_m, double z_m);

}  // namespace truepose::formats
