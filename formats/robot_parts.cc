#include "formats/robot_parts.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "formats/number.h"
#include "formats/rotation.h"
#include "formats/strings.h"
#include "formats/wording.h"

namespace truepose::formats {
namespace {

// n numbers of a list; fewer when one is none.
std::vector<double> ReadNumbers(const YamlNode& node, const std::string& path, int n,
                                const YamlFaults& faults) {
  std::vector<double> numbers;
  const std::vector<YamlNode>& items = ListItems(node, path, faults);
  for (size_t i = 0; i < items.size(); ++i) {
    if (const auto number = NumberOf(items[i], ItemPath(path, i), faults))
      numbers.push_back(*number);
  }
  if (node.kind == YamlNode::Kind::kSequence && static_cast<int>(items.size()) != n) {
    faults.Add(node.line, path, StrCat(items.size(), " numbers"), StrCat(n, ", as many as joints"));
  }
  return numbers;
}

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
    for (const double s : ReadNumbers(rows[i], ItemPath(path, i), n, map.faults()))
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
  const std::vector<double> values = ReadNumbers(*node, path, n, map.faults());
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

// All four or none of them; nullopt after a fault.
std::optional<QuaternionArray> ReadQuaternion(YamlMap& map) {
  constexpr std::array<std::string_view, 4> kKeys = {"qx", "qy", "qz", "qw"};
  QuaternionArray q = {0, 0, 0, 1};
  size_t found = 0, there = 0;
  for (size_t i = 0; i < kKeys.size(); ++i) {
    there += map.Find(kKeys[i]) != nullptr;
    const auto number = map.FindNumber(kKeys[i]);
    if (!number) continue;
    ++found;
    q[i] = number->value;
  }
  if (there != 0 && there != kKeys.size()) {
    map.faults().Add(map.node().line, map.path(), StrCat(there, " of qx, qy, qz, qw"),
                     "all four or none");
  }
  if (found != there || (there != 0 && there != kKeys.size())) return std::nullopt;
  return q;
}

void SetRotation(YamlMap& map, QuaternionArray q, v1::Pose& pose) {
  if (!NormaliseRounded(q)) {
    map.faults().Add(map.node().line, StrCat(map.path(), ".qx,qy,qz,qw"),
                     StrCat("a length of ", FormatNumber(Length(q))), "1 within 0.001");
    return;
  }
  const double sign = q[3] < 0 ? -1 : 1;
  pose.set_qx(sign * q[0]);
  pose.set_qy(sign * q[1]);
  pose.set_qz(sign * q[2]);
  pose.set_qw(sign * q[3]);
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
  if (const auto q = ReadQuaternion(map)) SetRotation(map, *q, pose);
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
