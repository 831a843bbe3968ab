#include "formats/fixture_file.h"

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "formats/feature_uncertainty.h"
#include "formats/number.h"
#include "formats/strings.h"
#include "formats/text_file.h"
#include "formats/wording.h"
#include "formats/yaml.h"
#include "formats/yaml_map.h"
#include "formats/yaml_pose.h"

namespace truepose::formats {
namespace {

// Thousands of features; the YAML library is slow on what is much larger.
constexpr size_t kMostBytes = 1 << 20;

v1::FeatureKind ReadKind(YamlMap& map) {
  const std::optional<std::string> kind = map.FindRequiredText("kind");
  if (kind == "pose") return v1::FEATURE_POSE;
  if (kind == "point") return v1::FEATURE_POINT;
  if (kind == "point_axis") return v1::FEATURE_POINT_AXIS;
  if (kind == "plane") return v1::FEATURE_PLANE;
  if (kind) map.AddFault("kind", Quoted(*kind), "pose, point, point_axis or plane");
  return v1::FEATURE_KIND_UNSPECIFIED;
}

void ReadPosition(YamlMap& map, v1::Pose* pose) {
  const Unit* unit = nullptr;
  const size_t before = map.faults().faults.faults().size();
  const YamlNode* node = map.FindWithUnit("position", Dimension::kLength, &unit);
  if (node == nullptr) {
    // A wrong unit is a fault already.
    if (map.faults().faults.faults().size() > before) return;
    map.faults().Add(map.node().line, FieldPath(map.path(), "position_mm"), "no such key",
                     "position_mm or position_m");
    return;
  }
  const std::string path = FieldPath(map.path(), node->key);
  const std::vector<double> p = NumbersOf(*node, path, 3, "x, y, z", map.faults());
  if (p.size() != 3) return;
  pose->set_x_m(unit->to_si(p[0]));
  pose->set_y_m(unit->to_si(p[1]));
  pose->set_z_m(unit->to_si(p[2]));
}

// The least turn that carries z to the axis.
QuaternionArray TurnOfZ(const std::vector<double>& axis) {
  QuaternionArray q = {-axis[1], axis[0], 0, 1 + axis[2]};
  const double length = Length(q);
  if (length < 1e-9) return {1, 0, 0, 0};
  for (double& value : q) value /= length;
  return q;
}

std::optional<QuaternionArray> FromAxis(const YamlMap& map, const YamlNode& node) {
  const std::string path = FieldPath(map.path(), node.key);
  std::vector<double> axis = NumbersOf(node, path, 3, "x, y, z", map.faults());
  if (axis.size() != 3) return std::nullopt;
  if (NormaliseRounded(axis)) return TurnOfZ(axis);
  map.AddFault(node.key, StrCat("a length of ", FormatNumber(Length(axis))), "1 within 0.001");
  return std::nullopt;
}

// Roll, pitch and yaw about the fixed axes x, y, z: R(z, yaw) R(y, pitch) R(x, roll).
std::optional<QuaternionArray> FromRpy(const YamlMap& map, const YamlNode& node, const Unit& unit) {
  const std::string path = FieldPath(map.path(), node.key);
  const std::vector<double> angles = NumbersOf(node, path, 3, "roll, pitch, yaw", map.faults());
  if (angles.size() != 3) return std::nullopt;
  const auto convention = ParseEulerConvention("xyz-extrinsic");
  return FromEuler(*convention,
                   {unit.to_si(angles[0]), unit.to_si(angles[1]), unit.to_si(angles[2])});
}

void CheckOneOrientation(const YamlMap& map, bool quaternion, const YamlNode* rpy,
                         const YamlNode* axis, v1::FeatureKind kind) {
  const int found = quaternion + (rpy != nullptr) + (axis != nullptr);
  if (kind == v1::FEATURE_POINT && found > 0) {
    map.faults().Add(map.node().line, map.path(), "an orientation", "none: a point has none");
  } else if (found > 1) {
    map.faults().Add(map.node().line, map.path(), "several orientations",
                     "one of qx, qy, qz, qw, of rpy_deg and of axis");
  } else if (kind == v1::FEATURE_POSE && axis != nullptr) {
    map.AddFault("axis", "an axis alone", "qx, qy, qz, qw or rpy_deg: a pose does not turn freely");
  }
}

// No rotation when there is no key of one.
void ReadOrientation(YamlMap& map, v1::FeatureKind kind, v1::Pose* pose) {
  const Unit* unit = nullptr;
  const YamlNode* rpy = map.FindWithUnit("rpy", Dimension::kAngle, &unit);
  const YamlNode* axis = map.Find("axis");
  bool quaternion = false;
  for (const char* key : {"qx", "qy", "qz", "qw"}) quaternion |= map.Find(key) != nullptr;
  CheckOneOrientation(map, quaternion, rpy, axis, kind);
  std::optional<QuaternionArray> q = FindQuaternion(map);
  if (rpy != nullptr) q = FromRpy(map, *rpy, *unit);
  if (axis != nullptr) q = FromAxis(map, *axis);
  if (q) SetRotation(*q, pose);
}

v1::Feature ReadFeature(const YamlNode& node, const std::string& path, const YamlFaults& faults,
                        FieldLines& lines) {
  v1::Feature feature;
  YamlMap map(node, path, faults);
  if (!map.is_map()) return feature;
  lines.Set(path, node.line);
  feature.set_name(map.FindRequiredText("name").value_or(""));
  feature.set_kind(ReadKind(map));
  ReadPosition(map, feature.mutable_pose());
  ReadOrientation(map, feature.kind(), feature.mutable_pose());
  ReadUncertainty(map, &feature, lines);
  map.CheckKeys();
  return feature;
}

void CheckNames(const v1::Fixture& fixture, const FieldLines& lines, const YamlFaults& faults) {
  std::map<std::string, int> first;
  for (int i = 0; i < fixture.features_size(); ++i) {
    const std::string& name = fixture.features(i).name();
    const auto [other, is_new] = first.try_emplace(name, i);
    if (is_new || name.empty()) continue;
    const std::string path = ItemPath("features", i);
    faults.Add(lines.LineOf(path), FieldPath(path, "name"), StrCat(Quoted(name), " a second time"),
               StrCat("a name other than that of ", ItemPath("features", other->second)));
  }
}

void ReadFeatures(YamlMap& top, FixtureFile& file) {
  const YamlNode* node = top.FindRequired("features");
  if (node == nullptr) return;
  file.lines.Set("features", node->line);
  const std::vector<YamlNode>& items = ListItems(*node, "features", top.faults());
  for (size_t i = 0; i < items.size(); ++i) {
    *file.fixture.add_features() =
        ReadFeature(items[i], ItemPath("features", i), top.faults(), file.lines);
  }
  if (items.empty() && node->kind == YamlNode::Kind::kSequence) {
    top.AddFault("features", "an empty list", "at least one feature");
  }
  CheckNames(file.fixture, file.lines, top.faults());
}

}  // namespace

absl::StatusOr<FixtureFile> ReadFixtureFile(const std::string& path) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string text, ReadTextFile(path, kMostBytes));
  return ParseFixtureFile(text, path);
}

absl::StatusOr<FixtureFile> ParseFixtureFile(std::string_view text, std::string_view file_name) {
  FaultList list;
  const YamlNode root = ParseYaml(text, file_name, list);
  if (!list.empty()) return list.ToStatus();
  const YamlFaults faults{file_name, list};
  YamlMap top(root, "", faults);
  if (!top.is_map()) return list.ToStatus();
  FixtureFile file{{}, FieldLines(file_name)};
  file.fixture.set_name(top.FindRequiredText("name").value_or(""));
  ReadFeatures(top, file);
  top.CheckKeys();
  if (!list.empty()) return list.ToStatus();
  return file;
}

}  // namespace truepose::formats
