#include "formats/robot_elements.h"

#include <array>
#include <vector>

#include "absl/strings/numbers.h"
#include "formats/strings.h"
#include "formats/wording.h"

namespace truepose::formats {

struct ElementForm {
  std::string_view stem;
  v1::ElementaryTransform::Motion motion;
  v1::Axis axis;
};

namespace {

constexpr std::array<ElementForm, 6> kForms = {{
    {"tx", v1::ElementaryTransform::TRANSLATION, v1::X},
    {"ty", v1::ElementaryTransform::TRANSLATION, v1::Y},
    {"tz", v1::ElementaryTransform::TRANSLATION, v1::Z},
    {"rx", v1::ElementaryTransform::ROTATION, v1::X},
    {"ry", v1::ElementaryTransform::ROTATION, v1::Y},
    {"rz", v1::ElementaryTransform::ROTATION, v1::Z},
}};

Dimension DimensionOf(const ElementForm& form) {
  return form.motion == v1::ElementaryTransform::ROTATION ? Dimension::kAngle : Dimension::kLength;
}

}  // namespace

std::optional<int> FindJoint(const YamlMap& map, const YamlNode& node, const v1::Nominal& nominal) {
  int number = 0;
  if (node.kind == YamlNode::Kind::kScalar) {
    if (absl::SimpleAtoi(node.text, &number) && number >= 1 && number <= nominal.joints_size()) {
      return number - 1;
    }
    for (int i = 0; i < nominal.joints_size(); ++i) {
      if (nominal.joints(i).name() == node.text) return i;
    }
  }
  if (nominal.joints_size() == 0) return std::nullopt;
  map.AddFault(node.key, Describe(node),
               StrCat("the name of a joint or its number, 1 to ", nominal.joints_size()));
  return std::nullopt;
}

void ElementReader::ReadList(const YamlNode& node, const std::string& path,
                             const std::string& message_path, bool with_joints,
                             Elements* elements) {
  lines_.Set(message_path, node.line);
  const std::vector<YamlNode>& items = ListItems(node, path, faults_);
  for (size_t i = 0; i < items.size(); ++i) {
    lines_.Set(ItemPath(message_path, i), items[i].line);
    *elements->Add() = ReadElement(items[i], ItemPath(path, i), with_joints);
  }
}

void ElementReader::CheckAllJoints(const YamlNode& chain, const std::string& path) const {
  if (chain.kind != YamlNode::Kind::kSequence) return;
  for (int i = 0; i < nominal_.joints_size(); ++i) {
    if (used_.count(i) > 0) continue;
    faults_.Add(chain.line, path,
                StrCat("no element of joint ", i + 1, ", ", Quoted(nominal_.joints(i).name())),
                StrCat(nominal_.joints_size(), ", one for each of the joints"));
  }
}

v1::ElementaryTransform ElementReader::ReadElement(const YamlNode& node, const std::string& path,
                                                   bool with_joints) {
  v1::ElementaryTransform element;
  YamlMap map(node, path, faults_);
  int found = 0;
  for (const ElementForm& form : kForms) found += ReadForm(map, form, with_joints, element);
  map.CheckKeys();
  const size_t keys = node.items.size();
  if (map.is_map() && (found > 1 || keys == 0)) {
    faults_.Add(node.line, path, StrCat(found, " transforms"), "one, such as {tz_mm: 127.3}");
  }
  return element;
}

// True when the map has a key of that kind.
bool ElementReader::ReadForm(YamlMap& map, const ElementForm& form, bool with_joints,
                             v1::ElementaryTransform& element) {
  const std::string joint_key = StrCat(form.stem, "_joint");
  const YamlNode* joint = with_joints ? map.Find(joint_key) : nullptr;
  const auto constant = map.FindMeasure(form.stem, DimensionOf(form));
  if (joint == nullptr && !constant) return false;
  element.set_motion(form.motion);
  element.set_axis(form.axis);
  if (constant) element.set_constant(constant->value);
  if (joint == nullptr) return true;
  const std::optional<int> index = FindJoint(map, *joint, nominal_);
  if (index && IsUsable(map, *joint, *index, form)) element.set_joint(*index);
  return true;
}

bool ElementReader::IsUsable(const YamlMap& map, const YamlNode& node, int index,
                             const ElementForm& form) {
  const bool prismatic = nominal_.joints(index).type() == v1::PRISMATIC;
  const bool translates = form.motion == v1::ElementaryTransform::TRANSLATION;
  if (nominal_.joints(index).type() != v1::JOINT_TYPE_UNSPECIFIED && prismatic != translates) {
    map.AddFault(node.key, StrCat(prismatic ? "prismatic" : "revolute", " joint ", Describe(node)),
                 prismatic ? "tx_joint, ty_joint or tz_joint" : "rx_joint, ry_joint or rz_joint");
  }
  if (used_.insert(index).second) return true;
  map.AddFault(node.key, StrCat("joint ", Describe(node), " a second time"), "each joint once");
  return false;
}

}  // namespace truepose::formats
