#include "formats/ur_calibration.h"

#include <array>

#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "formats/joint_origins.h"
#include "formats/number.h"
#include "formats/strings.h"
#include "formats/yaml.h"
#include "formats/yaml_map.h"

namespace truepose::formats {
namespace {

constexpr std::array<std::string_view, 6> kLinks = {"shoulder", "upper_arm", "forearm",
                                                    "wrist_1",  "wrist_2",   "wrist_3"};

bool IsAtOnce(const JointOrigin& o) {
  return o.x == 0 && o.y == 0 && o.z == 0 && o.roll == 0 && o.pitch == 0 && o.yaw == 0;
}

std::string LinkText(std::string_view link, const JointOrigin& origin) {
  std::string out = StrCat("  ", link, ":\n");
  const auto line = [&](std::string_view key, double value) {
    StrAppend(&out, "    ", key, ": ", FormatNumber(value), "\n");
  };
  line("x", origin.x);
  line("y", origin.y);
  line("z", origin.z);
  line("roll", origin.roll);
  line("pitch", origin.pitch);
  line("yaw", origin.yaw);
  return out;
}

JointOrigin ReadLink(const YamlNode& node, const YamlFaults& faults) {
  YamlMap map(node, FieldPath("kinematics", node.key), faults);
  const auto value = [&](std::string_view key) {
    map.FindRequired(key);
    return map.FindNumber(key).value_or(YamlNumber()).value;
  };
  JointOrigin origin;
  if (!map.is_map()) return origin;
  origin.x = value("x");
  origin.y = value("y");
  origin.z = value("z");
  origin.roll = value("roll");
  origin.pitch = value("pitch");
  origin.yaw = value("yaw");
  map.CheckKeys();
  return origin;
}

void ReadKinematics(YamlMap& map, const YamlFaults& faults, UrCalibration* calibration) {
  Elements* elements = calibration->geometry.mutable_chain()->mutable_elements();
  for (size_t i = 0; i < kLinks.size(); ++i) {
    const YamlNode* node = map.FindRequired(kLinks[i]);
    if (node == nullptr) continue;
    AppendOrigin(ReadLink(*node, faults), elements);
    AppendJoint(v1::REVOLUTE, static_cast<int>(i), elements);
  }
  calibration->hash = map.FindRequiredText("hash").value_or("");
  map.CheckKeys();
}

}  // namespace

absl::StatusOr<std::string> WriteUrCalibration(const UrCalibration& calibration) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::vector<JointOrigin> origins,
                            JointOriginsOf(calibration.geometry));
  if (origins.size() != kLinks.size() + 1 || !IsAtOnce(origins.back()))
    return FaultStatus("geometry", "another form of geometry",
                       "six joints and nothing behind the last");
  std::string out = "kinematics:\n";
  for (size_t i = 0; i < kLinks.size(); ++i) out += LinkText(kLinks[i], origins[i]);
  return StrCat(out, "  hash: ", YamlText(calibration.hash), "\n");
}

absl::StatusOr<UrCalibration> ParseUrCalibration(std::string_view text,
                                                 std::string_view file_name) {
  FaultList list;
  const YamlNode root = ParseYaml(text, file_name, list);
  if (!list.empty()) return list.ToStatus();
  const YamlFaults faults{file_name, list};
  YamlMap top(root, "", faults);
  UrCalibration calibration;
  if (const YamlNode* node = top.is_map() ? top.FindRequired("kinematics") : nullptr) {
    YamlMap map(*node, "kinematics", faults);
    if (map.is_map()) ReadKinematics(map, faults, &calibration);
  }
  if (top.is_map()) top.CheckKeys();
  if (!list.empty()) return list.ToStatus();
  return calibration;
}

}  // namespace truepose::formats
