#include "formats/feature_uncertainty.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "absl/strings/str_join.h"
#include "formats/number.h"
#include "formats/strings.h"
#include "formats/wording.h"

namespace truepose::formats {
namespace {

constexpr int kSize = 6;
using Deviations = std::array<double, kSize>;

bool HasOrientation(const v1::Feature& feature) {
  return feature.kind() != v1::FEATURE_POINT && feature.kind() != v1::FEATURE_PLANE;
}

// One number for all three, or one each.
std::vector<double> ThreeOf(const YamlMap& map, const YamlNode& node) {
  const std::string path = FieldPath(map.path(), node.key);
  if (node.kind == YamlNode::Kind::kSequence)
    return NumbersOf(node, path, 3, "one along each axis", map.faults());
  const auto number = NumberOf(node, path, map.faults());
  return number ? std::vector<double>(3, *number) : std::vector<double>();
}

// @param first of the three in `sd`. False when there is no such key.
bool ReadDeviations(YamlMap& map, Dimension dimension, size_t first, Deviations* sd) {
  const Unit* unit = nullptr;
  const YamlNode* node = map.FindWithUnit("sd", dimension, &unit);
  if (node == nullptr) return false;
  const std::vector<double> values = ThreeOf(map, *node);
  for (size_t i = 0; i < values.size() && i < 3; ++i) {
    if (values[i] < 0) {
      map.AddFault(node->key, FormatNumber(values[i]), "a standard deviation, at least 0");
    }
    (*sd)[first + i] = unit->to_si(values[i]);
  }
  return true;
}

void SetDiagonal(const Deviations& sd, v1::Feature* feature) {
  feature->mutable_covariance()->Resize(kSize * kSize, 0.0);
  for (int i = 0; i < kSize; ++i) feature->set_covariance(i * (kSize + 1), sd[i] * sd[i]);
}

// Row by row; to m and rad when the unit of lengths is mm.
void ReadMatrix(const YamlMap& map, const YamlNode& node, bool millimetres, v1::Feature* feature) {
  const std::string path = FieldPath(map.path(), node.key);
  const double length = millimetres ? 1e-3 : 1;
  const double angle = millimetres ? std::numbers::pi / 180 : 1;
  const auto scale = [&](size_t i) { return i < 3 ? length : angle; };
  const std::vector<YamlNode>& rows = ListItems(node, path, map.faults());
  if (node.kind == YamlNode::Kind::kSequence && rows.size() != kSize)
    map.AddFault(node.key, StrCat(rows.size(), " rows"), "6: x, y, z and the turns about them");
  for (size_t i = 0; i < rows.size(); ++i) {
    const std::vector<double> row =
        NumbersOf(rows[i], ItemPath(path, i), kSize, "as many as rows", map.faults());
    for (size_t k = 0; k < row.size(); ++k) feature->add_covariance(row[k] * scale(i) * scale(k));
  }
}

// The key of a whole covariance, of which there may be one.
const YamlNode* FindMatrix(YamlMap& map, bool* millimetres) {
  const YamlNode* people = map.Find("covariance_mm_deg");
  const YamlNode* si = map.Find("covariance_m_rad");
  if (people != nullptr && si != nullptr)
    map.AddFault("covariance_m_rad", "a second value beside covariance_mm_deg", "one of them");
  *millimetres = people != nullptr;
  return people != nullptr ? people : si;
}

// The deviation of a variance, when its square is the same bits.
std::optional<double> ExactRoot(double variance) {
  const double root = std::sqrt(variance);
  // Rounding makes the root of a square miss by at most a unit in the last place.
  for (const double sd : {root, std::nextafter(root, 0.0), std::nextafter(root, INFINITY)}) {
    if (sd * sd == variance) return sd;
  }
  return std::nullopt;
}

std::optional<Deviations> DeviationsOf(const v1::Feature& feature) {
  Deviations sd;
  for (int i = 0; i < kSize * kSize; ++i) {
    const double value = feature.covariance(i);
    if (i % (kSize + 1) != 0) {
      if (value != 0 || std::signbit(value)) return std::nullopt;
      continue;
    }
    const std::optional<double> root = ExactRoot(value);
    if (!root) return std::nullopt;
    sd[i / (kSize + 1)] = *root;
  }
  return sd;
}

// The shortest of the deviations with that square in the unit for people, else in m or rad.
std::string DeviationText(const Deviations& sd, int first, Dimension dimension) {
  const bool lengths = dimension == Dimension::kLength;
  const std::string_view people = lengths ? "mm" : "deg";
  std::vector<std::string> for_people, si;
  for (int i = first; i < first + 3; ++i) {
    si.push_back(FormatNumber(sd[i]));
    for (const double near : {sd[i], std::nextafter(sd[i], 0.0), std::nextafter(sd[i], INFINITY)}) {
      const Measure measure = MeasureForPeople(near, dimension);
      if (near * near != sd[i] * sd[i] || measure.symbol != people) continue;
      for_people.push_back(measure.digits);
      break;
    }
  }
  const bool exact = for_people.size() == 3;
  const std::string unit = exact ? std::string(people) : lengths ? "m" : "rad";
  return StrCat(", sd_", unit, ": [", absl::StrJoin(exact ? for_people : si, ", "), "]");
}

std::string MatrixText(const v1::Feature& feature) {
  std::vector<std::string> rows;
  for (int i = 0; i < kSize; ++i) {
    std::vector<std::string> row;
    for (int k = 0; k < kSize; ++k) row.push_back(FormatNumber(feature.covariance(i * kSize + k)));
    rows.push_back(StrCat("[", absl::StrJoin(row, ", "), "]"));
  }
  return StrCat(", covariance_m_rad: [", absl::StrJoin(rows, ", "), "]");
}

}  // namespace

void ReadUncertainty(YamlMap& map, v1::Feature* feature, FieldLines& lines) {
  // Both units are known names before either is read, else one's would be a wrong unit of the
  // other.
  for (const char* key : {"sd_mm", "sd_m", "sd_deg", "sd_rad"}) map.Find(key);
  Deviations sd = {};
  const bool lengths = ReadDeviations(map, Dimension::kLength, 0, &sd);
  const bool angles = ReadDeviations(map, Dimension::kAngle, 3, &sd);
  bool millimetres = false;
  const YamlNode* matrix = FindMatrix(map, &millimetres);
  if (angles && !HasOrientation(*feature) && feature->kind() != v1::FEATURE_KIND_UNSPECIFIED) {
    map.faults().Add(map.node().line, map.path(), "a deviation of an angle",
                     "sd_mm only: of a point or plane a length is observed");
  }
  if (matrix != nullptr && (lengths || angles))
    map.AddFault(matrix->key, "a covariance beside sd_mm or sd_deg", "one of them");
  if (lengths || angles) SetDiagonal(sd, feature);
  if (matrix == nullptr) return;
  feature->clear_covariance();
  lines.Set(FieldPath(map.path(), "covariance"), matrix->line);
  ReadMatrix(map, *matrix, millimetres, feature);
}

std::string UncertaintyText(const v1::Feature& feature) {
  if (feature.covariance_size() != kSize * kSize) return "";
  const std::optional<Deviations> sd = DeviationsOf(feature);
  const bool angles = HasOrientation(feature);
  if (!sd || (!angles && (*sd)[3] + (*sd)[4] + (*sd)[5] > 0)) return MatrixText(feature);
  return StrCat(DeviationText(*sd, 0, Dimension::kLength),
                angles ? DeviationText(*sd, 3, Dimension::kAngle) : "");
}

}  // namespace truepose::formats
