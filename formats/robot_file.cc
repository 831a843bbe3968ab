#include "formats/robot_file.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "absl/strings/ascii.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "formats/robot_parts.h"
#include "formats/strings.h"
#include "formats/text_file.h"
#include "formats/wording.h"
#include "formats/yaml.h"
#include "formats/yaml_map.h"

namespace truepose::formats {
namespace {

// A robot file has some kilobytes; the YAML library is slow on what is much larger.
constexpr size_t kMostBytes = 1 << 20;
// Far above any arm; a joint map has the square of it.
constexpr size_t kMostJoints = 64;

bool IsRobotId(std::string_view text) {
  const auto is_id = [](char c) {
    return absl::ascii_islower(c) || absl::ascii_isdigit(c) || c == '-';
  };
  return !text.empty() && text.size() <= 63 && text[0] != '-' &&
         std::all_of(text.begin(), text.end(), is_id);
}

bool IsWholeNumber(std::string_view text) {
  return std::all_of(text.begin(), text.end(), absl::ascii_isdigit);
}

void NoteLine(const YamlMap& map, const YamlNode* node, FieldLines& lines) {
  if (node != nullptr) lines.Set(FieldPath(map.path(), node->key), node->line);
}

void ReadKind(YamlMap& top, v1::Nominal& nominal) {
  const std::optional<std::string> kind = top.FindText("kind");
  nominal.set_kind(kind == "measuring" ? v1::MEASURING : v1::INDUSTRIAL);
  if (kind.has_value() && kind != "measuring" && kind != "industrial") {
    top.AddFault("kind", Quoted(*kind), "industrial or measuring");
  }
}

void ReadIdentity(YamlMap& top, RobotFile& file) {
  file.robot_id = top.FindRequiredText("robot").value_or("");
  if (!file.robot_id.empty() && !IsRobotId(file.robot_id)) {
    top.AddFault("robot", Quoted(file.robot_id),
                 "lower-case letters, digits and -, at most 63, not - first");
  }
  file.nominal.set_serial(top.FindText("serial").value_or(""));
  file.nominal.set_manufacturer(top.FindText("manufacturer").value_or(""));
  file.nominal.set_model(top.FindText("model").value_or(""));
  ReadKind(top, file.nominal);
  for (const char* key : {"serial", "manufacturer", "model", "kind"}) {
    NoteLine(top, top.Find(key), file.lines);
  }
}

v1::JointType ReadType(YamlMap& map) {
  const std::optional<std::string> type = map.FindRequiredText("type");
  if (type == "revolute") return v1::REVOLUTE;
  if (type == "prismatic") return v1::PRISMATIC;
  if (type.has_value()) map.AddFault("type", Quoted(*type), "revolute or prismatic");
  return v1::JOINT_TYPE_UNSPECIFIED;
}

// Without a type nobody knows which units its limits may have.
void ReadLimits(YamlMap& map, v1::Joint& joint, FieldLines& lines) {
  const bool prismatic = joint.type() == v1::PRISMATIC;
  const Dimension dimension = prismatic ? Dimension::kLength : Dimension::kAngle;
  const auto lower = map.FindMeasure("lower", dimension);
  const auto upper = map.FindMeasure("upper", dimension);
  if (lower) {
    joint.set_lower(lower->value);
    lines.Set(FieldPath(map.path(), "lower"), lower->line);
  }
  if (upper) {
    joint.set_upper(upper->value);
    lines.Set(FieldPath(map.path(), "upper"), upper->line);
  }
  if (!lower || !upper || lower->value < upper->value) return;
  map.faults().Add(upper->line, FieldPath(map.path(), "upper"), "a limit not above the lower one",
                   "lower < upper");
}

v1::Joint ReadJoint(const YamlNode& node, size_t index, const YamlFaults& faults,
                    FieldLines& lines) {
  v1::Joint joint;
  YamlMap map(node, ItemPath("joints", index), faults);
  if (!map.is_map()) return joint;
  lines.Set(map.path(), node.line);
  joint.set_name(map.FindRequiredText("name").value_or(""));
  if (!joint.name().empty() && IsWholeNumber(joint.name())) {
    map.AddFault("name", Quoted(joint.name()), "a name that is not a number");
  }
  NoteLine(map, map.Find("name"), lines);
  joint.set_type(ReadType(map));
  NoteLine(map, map.Find("type"), lines);
  if (joint.type() != v1::JOINT_TYPE_UNSPECIFIED) {
    ReadLimits(map, joint, lines);
    map.CheckKeys();
  }
  return joint;
}

void CheckJointNames(const v1::Nominal& nominal, const FieldLines& lines,
                     const YamlFaults& faults) {
  std::map<std::string, int> first;
  for (int i = 0; i < nominal.joints_size(); ++i) {
    const std::string& name = nominal.joints(i).name();
    const auto [other, is_new] = first.try_emplace(name, i);
    if (is_new || name.empty()) continue;
    const std::string path = FieldPath(ItemPath("joints", i), "name");
    faults.Add(lines.LineOf(path), path, StrCat(Quoted(name), " a second time"),
               StrCat("a name other than that of ", ItemPath("joints", other->second)));
  }
}

void ReadJoints(YamlMap& top, v1::Nominal& nominal, FieldLines& lines) {
  const YamlNode* node = top.FindRequired("joints");
  if (node == nullptr) return;
  lines.Set("joints", node->line);
  const std::vector<YamlNode>& items = ListItems(*node, "joints", top.faults());
  if (items.size() > kMostJoints) {
    return top.AddFault("joints", StrCat(items.size(), " joints"), StrCat("at most ", kMostJoints));
  }
  for (size_t i = 0; i < items.size(); ++i) {
    *nominal.add_joints() = ReadJoint(items[i], i, top.faults(), lines);
  }
  if (items.empty() && node->kind == YamlNode::Kind::kSequence) {
    top.AddFault("joints", "an empty list", "at least one joint");
  }
  CheckJointNames(nominal, lines, top.faults());
}

}  // namespace

absl::StatusOr<RobotFile> ReadRobotFile(const std::string& path) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string text, ReadTextFile(path, kMostBytes));
  return ParseRobotFile(text, path);
}

absl::StatusOr<RobotFile> ParseRobotFile(std::string_view text, std::string_view file_name) {
  FaultList list;
  const YamlNode root = ParseYaml(text, file_name, list);
  if (!list.empty()) return list.ToStatus();
  const YamlFaults faults{file_name, list};
  YamlMap top(root, "", faults);
  if (!top.is_map()) return list.ToStatus();
  RobotFile file{"", {}, FieldLines(file_name)};
  ReadIdentity(top, file);
  ReadJoints(top, file.nominal, file.lines);
  ReadGeometry(top, file.nominal, file.lines);
  ReadJointMap(top, file.nominal, file.lines);
  ReadTools(top, file.nominal, file.lines);
  ReadMasses(top, file.nominal, file.lines);
  top.CheckKeys();
  if (!list.empty()) return list.ToStatus();
  return file;
}

}  // namespace truepose::formats
