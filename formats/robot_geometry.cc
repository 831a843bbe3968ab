#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "absl/strings/numbers.h"
#include "formats/robot_parts.h"
#include "formats/strings.h"
#include "formats/wording.h"

namespace truepose::formats {
namespace {

struct ElementKind {
  std::string_view stem;
  v1::ElementaryTransform::Motion motion;
  v1::Axis axis;
};

constexpr std::array<ElementKind, 6> kElementKinds = {{
    {"tx", v1::ElementaryTransform::TRANSLATION, v1::X},
    {"ty", v1::ElementaryTransform::TRANSLATION, v1::Y},
    {"tz", v1::ElementaryTransform::TRANSLATION, v1::Z},
    {"rx", v1::ElementaryTransform::ROTATION, v1::X},
    {"ry", v1::ElementaryTransform::ROTATION, v1::Y},
    {"rz", v1::ElementaryTransform::ROTATION, v1::Z},
}};

Dimension DimensionOf(const ElementKind& kind) {
  return kind.motion == v1::ElementaryTransform::ROTATION ? Dimension::kAngle : Dimension::kLength;
}

std::string CountOfJoints(const v1::Nominal& nominal) {
  return StrCat(nominal.joints_size(), ", one for each of the joints");
}

// Reads the lists of elements of one robot.
class ElementReader {
 public:
  ElementReader(const v1::Nominal& nominal, const YamlFaults& faults, FieldLines& lines)
      : nominal_(nominal), faults_(faults), lines_(lines) {}

  // @param path of the list in the file; `message_path` of its elements in the message.
  template <class Elements>
  void ReadList(const YamlNode& node, const std::string& path, const std::string& message_path,
                bool with_joints, Elements* elements) {
    lines_.Set(message_path, node.line);
    const std::vector<YamlNode>& items = ListItems(node, path, faults_);
    for (size_t i = 0; i < items.size(); ++i) {
      lines_.Set(ItemPath(message_path, i), items[i].line);
      *elements->Add() = ReadElement(items[i], ItemPath(path, i), with_joints);
    }
  }

  // A chain moves each joint once.
  void CheckAllJoints(const YamlNode& chain, const std::string& path) const {
    if (chain.kind != YamlNode::Kind::kSequence) return;
    for (int i = 0; i < nominal_.joints_size(); ++i) {
      if (used_.count(i) > 0) continue;
      faults_.Add(chain.line, path,
                  StrCat("no element of joint ", i + 1, ", ", Quoted(nominal_.joints(i).name())),
                  CountOfJoints(nominal_));
    }
  }

 private:
  v1::ElementaryTransform ReadElement(const YamlNode& node, const std::string& path,
                                      bool with_joints) {
    v1::ElementaryTransform element;
    YamlMap map(node, path, faults_);
    int found = 0;
    for (const ElementKind& kind : kElementKinds)
      found += ReadKind(map, kind, with_joints, element);
    map.CheckKeys();
    const size_t keys = node.items.size();
    if (map.is_map() && (found > 1 || keys == 0)) {
      faults_.Add(node.line, path, StrCat(found, " transforms"), "one, such as {tz_mm: 127.3}");
    }
    return element;
  }

  // True when the map has a key of that kind.
  bool ReadKind(YamlMap& map, const ElementKind& kind, bool with_joints,
                v1::ElementaryTransform& element) {
    const std::string joint_key = StrCat(kind.stem, "_joint");
    const YamlNode* joint = with_joints ? map.Find(joint_key) : nullptr;
    const auto constant = map.FindMeasure(kind.stem, DimensionOf(kind));
    if (joint == nullptr && !constant) return false;
    element.set_motion(kind.motion);
    element.set_axis(kind.axis);
    if (constant) element.set_constant(constant->value);
    if (joint == nullptr) return true;
    const std::optional<int> index = JointIndex(map, *joint);
    if (index && IsUsable(map, *joint, *index, kind)) element.set_joint(*index);
    return true;
  }

  // From a number that counts from 1, or from a name.
  std::optional<int> JointIndex(const YamlMap& map, const YamlNode& node) const {
    int number = 0;
    if (node.kind == YamlNode::Kind::kScalar) {
      if (absl::SimpleAtoi(node.text, &number) && number >= 1 && number <= nominal_.joints_size()) {
        return number - 1;
      }
      for (int i = 0; i < nominal_.joints_size(); ++i) {
        if (nominal_.joints(i).name() == node.text) return i;
      }
    }
    if (nominal_.joints_size() == 0) return std::nullopt;
    map.AddFault(node.key, Describe(node),
                 StrCat("the name of a joint or its number, 1 to ", nominal_.joints_size()));
    return std::nullopt;
  }

  bool IsUsable(const YamlMap& map, const YamlNode& node, int index, const ElementKind& kind) {
    const bool prismatic = nominal_.joints(index).type() == v1::PRISMATIC;
    const bool translates = kind.motion == v1::ElementaryTransform::TRANSLATION;
    if (nominal_.joints(index).type() != v1::JOINT_TYPE_UNSPECIFIED && prismatic != translates) {
      map.AddFault(node.key,
                   StrCat(prismatic ? "prismatic" : "revolute", " joint ", Describe(node)),
                   prismatic ? "tx_joint, ty_joint or tz_joint" : "rx_joint, ry_joint or rz_joint");
    }
    if (used_.insert(index).second) return true;
    map.AddFault(node.key, StrCat("joint ", Describe(node), " a second time"), "each joint once");
    return false;
  }

  const v1::Nominal& nominal_;
  const YamlFaults& faults_;
  FieldLines& lines_;
  std::set<int> used_;
};

v1::DhRow ReadDhRow(const YamlNode& node, const std::string& path, const YamlFaults& faults) {
  v1::DhRow row;
  YamlMap map(node, path, faults);
  const auto read = [&](std::string_view stem, Dimension dimension) {
    return map.FindRequiredMeasure(stem, dimension).value_or(YamlNumber()).value;
  };
  row.set_theta_rad(read("theta", Dimension::kAngle));
  row.set_d_m(read("d", Dimension::kLength));
  row.set_a_m(read("a", Dimension::kLength));
  row.set_alpha_rad(read("alpha", Dimension::kAngle));
  map.CheckKeys();
  return row;
}

void ReadDhTable(const YamlNode& node, const std::string& path, const v1::Nominal& nominal,
                 const YamlFaults& faults, FieldLines& lines, v1::DhTable* table) {
  const std::string rows = FieldPath(path, "rows");
  lines.Set(path, node.line);
  const std::vector<YamlNode>& items = ListItems(node, path, faults);
  for (size_t i = 0; i < items.size(); ++i) {
    lines.Set(ItemPath(rows, i), items[i].line);
    *table->add_rows() = ReadDhRow(items[i], ItemPath(path, i), faults);
  }
  if (node.kind != YamlNode::Kind::kSequence) return;
  // Without joints there is a fault already.
  if (static_cast<int>(items.size()) == nominal.joints_size() || nominal.joints_size() == 0) return;
  faults.Add(node.line, path, StrCat(items.size(), " rows"), CountOfJoints(nominal));
}

void ReadConvention(YamlMap& map, const v1::Nominal& nominal, FieldLines& lines,
                    ElementReader& elements, v1::Geometry& geometry) {
  if (const YamlNode* node = map.Find("standard_dh")) {
    ReadDhTable(*node, "geometry.standard_dh", nominal, map.faults(), lines,
                geometry.mutable_standard_dh());
  }
  if (const YamlNode* node = map.Find("craig_dh")) {
    ReadDhTable(*node, "geometry.craig_dh", nominal, map.faults(), lines,
                geometry.mutable_craig_dh());
  }
  if (const YamlNode* node = map.Find("chain")) {
    elements.ReadList(*node, "geometry.chain", "geometry.chain.elements", true,
                      geometry.mutable_chain()->mutable_elements());
    elements.CheckAllJoints(*node, "geometry.chain");
  }
}

}  // namespace

void ReadGeometry(YamlMap& top, v1::Nominal& nominal, FieldLines& lines) {
  const YamlNode* node = top.FindRequired("geometry");
  if (node == nullptr) return;
  lines.Set("geometry", node->line);
  YamlMap map(*node, "geometry", top.faults());
  if (!map.is_map()) return;
  ElementReader elements(nominal, top.faults(), lines);
  v1::Geometry geometry;
  ReadConvention(map, nominal, lines, elements, geometry);
  const int found = (map.Find("standard_dh") != nullptr) + (map.Find("craig_dh") != nullptr) +
                    (map.Find("chain") != nullptr);
  if (found != 1) {
    top.AddFault("geometry", StrCat(found, " of standard_dh, craig_dh and chain"), "one of them");
  }
  if (const YamlNode* flange = map.Find("flange")) {
    elements.ReadList(*flange, "geometry.flange", "geometry.flange", false,
                      geometry.mutable_flange());
  }
  map.CheckKeys();
  *nominal.mutable_geometry() = geometry;
}

}  // namespace truepose::formats
