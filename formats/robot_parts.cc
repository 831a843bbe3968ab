#include "formats/robot_parts.h"

#include <string>
#include <vector>

#include "formats/number.h"
#include "formats/strings.h"
#include "formats/wording.h"
#include "formats/yaml_pose.h"

namespace truepose::formats {
namespace {

void ReadScale(YamlMap& map, int n, v1::JointMap& joint_map, FieldLines& lines) {
  const YamlNode* node = map.Find("scale");
  if (node == nullptr) {
    for (int i = 0; i < n * n; ++i) joint_map.add_scale(i % (n + 1) == 0 ? 1 : 0);
    return;
  }
  const std::string path = FieldPath(map.path(), "scale");
  lines.Set(path, node->line);
  const std::vector<YamlNode>& rows = ListItems(*node, path, map.faults());
  for (size_t i = 0; i < rows.size(); ++i) {
    for (const double s :
         NumbersOf(rows[i], ItemPath(path, i), n, "as many as joints", map.faults()))
      joint_map.add_scale(s);
  }
  if (node->kind == YamlNode::Kind::kSequence && static_cast<int>(rows.size()) != n) {
    map.AddFault("scale", StrCat(rows.size(), " rows"), StrCat(n, ", as many as joints"));
  }
}

// Revolute joints have theirs in offset_deg, prismatic ones in offset_mm; the other type's places
// hold 0.
void ReadOffsets(YamlMap& map, const v1::Nominal& nominal, Dimension dimension,
                 v1::JointMap& joint_map, FieldLines& lines) {
  const Unit* unit = nullptr;
  const YamlNode* node = map.FindWithUnit("offset", dimension, &unit);
  if (node == nullptr) return;
  lines.Set(FieldPath(map.path(), "offset"), node->line);
  const std::string path = FieldPath(map.path(), node->key);
  const int n = nominal.joints_size();
  const std::vector<double> values = NumbersOf(*node, path, n, "as many as joints", map.faults());
  if (static_cast<int>(values.size()) != n) return;
  for (int i = 0; i < n; ++i) {
    const bool prismatic = nominal.joints(i).type() == v1::PRISMATIC;
    if (prismatic == (dimension == Dimension::kLength)) {
      joint_map.set_offset(i, unit->to_si(values[i]));
    } else if (values[i] != 0) {
      map.faults().Add(node->line, ItemPath(path, i), FormatNumber(values[i]),
                       StrCat("0: joint ", i + 1, " is ", prismatic ? "prismatic" : "revolute"));
    }
  }
}

v1::Pose ReadPose(const YamlNode& node, const std::string& path, const YamlFaults& faults) {
  v1::Pose pose;
  YamlMap map(node, path, faults);
  const auto length = [&](std::string_view stem) {
    return map.FindMeasure(stem, Dimension::kLength).value_or(YamlNumber()).value;
  };
  pose.set_x_m(length("x"));
  pose.set_y_m(length("y"));
  pose.set_z_m(length("z"));
  if (const auto q = FindQuaternion(map)) SetRotation(*q, &pose);
  map.CheckKeys();
  return pose;
}

}  // namespace

void ReadJointMap(YamlMap& top, v1::Nominal& nominal, FieldLines& lines) {
  const YamlNode* node = top.Find("joint_map");
  if (node == nullptr) return;
  YamlMap map(*node, "joint_map", top.faults());
  if (!map.is_map()) return;
  lines.Set("joint_map", node->line);
  v1::JointMap joint_map;
  const int n = nominal.joints_size();
  // Without joints there is a fault already.
  if (n == 0) return;
  joint_map.mutable_offset()->Resize(n, 0.0);
  // Both lists are known names before either is read, else one's would be a wrong unit of the
  // other.
  for (const Dimension dimension : {Dimension::kAngle, Dimension::kLength}) {
    for (const std::string& name : NamesWithUnits("offset", dimension)) map.Find(name);
  }
  ReadScale(map, n, joint_map, lines);
  ReadOffsets(map, nominal, Dimension::kAngle, joint_map, lines);
  ReadOffsets(map, nominal, Dimension::kLength, joint_map, lines);
  map.CheckKeys();
  *nominal.mutable_joint_map() = joint_map;
}

void ReadTools(YamlMap& top, v1::Nominal& nominal, FieldLines& lines) {
  const YamlNode* node = top.Find("tools");
  if (node == nullptr) return;
  lines.Set("tools", node->line);
  const YamlMap map(*node, "tools", top.faults());
  if (!map.is_map()) return;
  for (size_t i = 0; i < node->items.size(); ++i) {
    const YamlNode& item = node->items[i];
    v1::Tool* tool = nominal.add_tools();
    lines.Set(ItemPath("tools", i), item.line);
    tool->set_name(item.key);
    if (item.key.empty()) top.faults().Add(item.line, "tools", "a tool without a name", "a name");
    *tool->mutable_pose() = ReadPose(item, FieldPath("tools", item.key), top.faults());
  }
}

}  // namespace truepose::formats
