#include "formats/known_column.h"

#include <algorithm>

#include "absl/strings/ascii.h"
#include "formats/strings.h"

namespace truepose::formats {
namespace {

void AddGroup(std::vector<KnownColumn>& known, Quantity quantity, Dimension dimension,
              const std::vector<std::string>& stems) {
  for (size_t i = 0; i < stems.size(); ++i) {
    known.push_back({stems[i], quantity, static_cast<int>(i), dimension});
  }
}

void AddJoint(std::vector<KnownColumn>& known, const v1::Joint& joint, int index) {
  const Dimension dimension =
      joint.type() == v1::PRISMATIC ? Dimension::kLength : Dimension::kAngle;
  const std::string stem = StrCat("q", index + 1);
  known.push_back({stem, Quantity::kMeasuredJoint, index, dimension});
  known.push_back({stem + "_cmd", Quantity::kCommandedJoint, index, dimension});
  known.push_back({StrCat("tau", index + 1), Quantity::kTorque, index, Dimension::kTorque});
}

bool IsText(Quantity quantity) {
  return quantity == Quantity::kTime || quantity == Quantity::kPlacement ||
         quantity == Quantity::kTarget || quantity == Quantity::kGroup ||
         quantity == Quantity::kAnchor || quantity == Quantity::kBeam ||
         quantity == Quantity::kFeature;
}

Quantity Later(Quantity first, int count) {
  return static_cast<Quantity>(static_cast<int>(first) + count);
}

void AddPoint(std::vector<KnownColumn>& known, int point) {
  const auto stems = [&](std::string_view infix) {
    std::vector<std::string> names;
    for (const char* axis : {"x", "y", "z"}) names.push_back(StrCat("p", point, infix, axis));
    return names;
  };
  AddGroup(known, PositionOfPoint(point), Dimension::kLength, stems("_"));
  AddGroup(known, DeviationOfPoint(point), Dimension::kLength, stems("_s"));
}

bool IsOneWord(std::string_view text) {
  return !text.empty() && text.find('_') == std::string_view::npos;
}

}  // namespace

std::vector<KnownColumn> KnownColumns(const v1::Nominal& nominal, bool with_euler) {
  std::vector<KnownColumn> known;
  for (int i = 0; i < nominal.joints_size(); ++i) AddJoint(known, nominal.joints(i), i);
  AddGroup(known, Quantity::kPosition, Dimension::kLength, {"x", "y", "z"});
  AddGroup(known, Quantity::kQuaternion, Dimension::kNone, {"qx", "qy", "qz", "qw"});
  if (with_euler) AddGroup(known, Quantity::kEuler, Dimension::kAngle, {"rx", "ry", "rz"});
  AddGroup(known, Quantity::kAxis, Dimension::kNone, {"axis_x", "axis_y", "axis_z"});
  AddGroup(known, Quantity::kPositionSd, Dimension::kLength, {"sx", "sy", "sz"});
  AddGroup(known, Quantity::kTemperature, Dimension::kTemperature, {"temp"});
  AddGroup(known, Quantity::kTime, Dimension::kNone, {"time"});
  AddGroup(known, Quantity::kPlacement, Dimension::kNone, {"placement"});
  AddGroup(known, Quantity::kTarget, Dimension::kNone, {"target"});
  AddGroup(known, Quantity::kGroup, Dimension::kNone, {"group"});
  return known;
}

std::vector<KnownColumn> SessionColumns(const v1::Nominal& nominal, bool with_euler) {
  std::vector<KnownColumn> known = KnownColumns(nominal, with_euler);
  for (KnownColumn& column : known) {
    column.alone =
        column.quantity == Quantity::kPosition || column.quantity == Quantity::kPositionSd;
  }
  // Before the distance, else its name without a unit would be a wrong unit of that.
  AddGroup(known, Quantity::kDistanceSd, Dimension::kLength, {"distance_sd"});
  AddGroup(known, Quantity::kDistance, Dimension::kLength, {"distance"});
  AddGroup(known, Quantity::kAnchor, Dimension::kNone, {"anchor"});
  AddGroup(known, Quantity::kBeam, Dimension::kNone, {"beam"});
  AddGroup(known, Quantity::kFeature, Dimension::kNone, {"feature"});
  for (int point = 1; point <= kMostPoints; ++point) AddPoint(known, point);
  return known;
}

Quantity PositionOfPoint(int point) { return Later(Quantity::kPoint1, point - 1); }

Quantity DeviationOfPoint(int point) { return Later(Quantity::kPoint1Sd, point - 1); }

bool IsNameOf(const KnownColumn& column, std::string_view name, const Unit** unit) {
  *unit = nullptr;
  if (!ConsumePrefix(&name, column.stem)) return false;
  if (column.dimension == Dimension::kNone) return name.empty();
  if (!ConsumePrefix(&name, "_")) return false;
  *unit = FindUnit(column.dimension, name);
  return *unit != nullptr;
}

bool IsSlipOf(const KnownColumn& column, std::string_view name) {
  const std::string lower = AsciiToLower(name);
  std::string_view rest = lower;
  if (!ConsumePrefix(&rest, column.stem)) return false;
  if (rest.empty()) return true;
  return !IsText(column.quantity) && ConsumePrefix(&rest, "_") && IsOneWord(rest);
}

bool LooksLikeJoint(std::string_view name) {
  const std::string lower = AsciiToLower(name);
  std::string_view rest = lower;
  if (!ConsumePrefix(&rest, "tau") && !ConsumePrefix(&rest, "q")) return false;
  const size_t digits = std::min(rest.find_first_not_of("0123456789"), rest.size());
  rest.remove_prefix(digits);
  ConsumePrefix(&rest, "_cmd");
  return digits > 0 && (rest.empty() || (ConsumePrefix(&rest, "_") && IsOneWord(rest)));
}

bool LooksLikePoint(std::string_view name) {
  const std::string lower = AsciiToLower(name);
  std::string_view rest = lower;
  if (!ConsumePrefix(&rest, "p")) return false;
  const size_t digits = std::min(rest.find_first_not_of("0123456789"), rest.size());
  rest.remove_prefix(digits);
  if (digits == 0 || !ConsumePrefix(&rest, "_")) return false;
  ConsumePrefix(&rest, "s");
  if (rest.empty() || rest[0] < 'x' || rest[0] > 'z') return false;
  rest.remove_prefix(1);
  return rest.empty() || (ConsumePrefix(&rest, "_") && IsOneWord(rest));
}

}  // namespace truepose::formats
