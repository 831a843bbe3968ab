#include <set>
#include <string>

#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "formats/joint_origins.h"
#include "formats/number.h"
#include "formats/strings.h"
#include "formats/urdf.h"

namespace truepose::formats {
namespace {

// URDF demands limits of a prismatic joint, and both of a revolute one.
constexpr double kNoLimit = 1e4;

std::string XmlText(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out += c;
    }
  }
  return out;
}

std::string Triple(double a, double b, double c) {
  return StrCat(FormatNumber(a), " ", FormatNumber(b), " ", FormatNumber(c));
}

std::string OriginLine(const JointOrigin& origin) {
  return StrCat("    <origin xyz=\"", Triple(origin.x, origin.y, origin.z), "\" rpy=\"",
                Triple(origin.roll, origin.pitch, origin.yaw), "\"/>\n");
}

std::string JointHead(std::string_view name, std::string_view type, std::string_view parent,
                      std::string_view child) {
  return StrCat("  <link name=\"", XmlText(child), "\"/>\n  <joint name=\"", XmlText(name),
                "\" type=\"", type, "\">\n    <parent link=\"", XmlText(parent),
                "\"/>\n    <child link=\"", XmlText(child), "\"/>\n");
}

std::string LimitLine(const v1::Joint& joint) {
  return StrCat("    <limit lower=\"", FormatNumber(joint.has_lower() ? joint.lower() : -kNoLimit),
                "\" upper=\"", FormatNumber(joint.has_upper() ? joint.upper() : kNoLimit),
                "\" effort=\"0\" velocity=\"0\"/>\n");
}

std::string JointText(const v1::Joint& joint, const JointOrigin& origin, std::string_view parent,
                      std::string_view child) {
  const bool prismatic = joint.type() == v1::PRISMATIC;
  const bool limited = prismatic || joint.has_lower() || joint.has_upper();
  const char* type = prismatic ? "prismatic" : limited ? "revolute" : "continuous";
  return StrCat(JointHead(joint.name(), type, parent, child), OriginLine(origin),
                "    <axis xyz=\"0 0 1\"/>\n", limited ? LimitLine(joint) : "", "  </joint>\n");
}

// A name for the fixed joint that no joint of the robot has.
std::string FlangeJoint(const v1::Nominal& nominal) {
  std::set<std::string> taken;
  for (const v1::Joint& joint : nominal.joints()) taken.insert(joint.name());
  std::string name = "flange_joint";
  while (taken.count(name) > 0) name += "_";
  return name;
}

bool IsIdentity(const v1::JointMap& map, int joints) {
  for (int i = 0; i < map.scale_size(); ++i) {
    if (map.scale(i) != (i % (joints + 1) == 0 ? 1 : 0)) return false;
  }
  for (const double offset : map.offset()) {
    if (offset != 0) return false;
  }
  return true;
}

}  // namespace

absl::StatusOr<std::string> WriteUrdf(const RobotFile& file) {
  const v1::Nominal& nominal = file.nominal;
  if (!IsIdentity(nominal.joint_map(), nominal.joints_size()))
    return FaultStatus("joint_map", "a joint map", "none: URDF has no place for it");
  TRUEPOSE_ASSIGN_OR_RETURN(const std::vector<JointOrigin> origins,
                            JointOriginsOf(nominal.geometry()));
  std::string out = StrCat("<?xml version=\"1.0\"?>\n<robot name=\"", XmlText(file.robot_id),
                           "\">\n  <link name=\"base\"/>\n");
  std::string parent = "base";
  for (int i = 0; i < nominal.joints_size(); ++i) {
    const std::string child = StrCat(nominal.joints(i).name(), "_link");
    out += JointText(nominal.joints(i), origins[i], parent, child);
    parent = child;
  }
  return StrCat(out, JointHead(FlangeJoint(nominal), "fixed", parent, "flange"),
                OriginLine(origins.back()), "  </joint>\n</robot>\n");
}

}  // namespace truepose::formats
