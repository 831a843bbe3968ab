#include <string>
#include <string_view>

#include "absl/strings/str_join.h"
#include "formats/number.h"
#include "formats/robot_file.h"
#include "formats/strings.h"
#include "formats/unit.h"
#include "formats/yaml.h"

namespace truepose::formats {
namespace {

Dimension DimensionOf(const v1::Joint& joint) {
  return joint.type() == v1::PRISMATIC ? Dimension::kLength : Dimension::kAngle;
}

// "d_mm: 127.3"
std::string Entry(std::string_view stem, double si, Dimension dimension) {
  const Measure measure = MeasureForPeople(si, dimension);
  return StrCat(stem, "_", measure.symbol, ": ", measure.digits);
}

void WriteText(std::string_view key, std::string_view text, std::string& out) {
  if (!text.empty()) StrAppend(&out, key, ": ", YamlText(text), "\n");
}

void WriteIdentity(const RobotFile& file, std::string& out) {
  const v1::Nominal& nominal = file.nominal;
  WriteText("robot", file.robot_id, out);
  WriteText("serial", nominal.serial(), out);
  WriteText("manufacturer", nominal.manufacturer(), out);
  WriteText("model", nominal.model(), out);
  WriteText("kind", nominal.kind() == v1::MEASURING ? "measuring" : "industrial", out);
}

void WriteJoint(const v1::Joint& joint, std::string& out) {
  StrAppend(&out, "  - {name: ", YamlText(joint.name()),
            ", type: ", joint.type() == v1::PRISMATIC ? "prismatic" : "revolute");
  const Dimension dimension = DimensionOf(joint);
  if (joint.has_lower()) StrAppend(&out, ", ", Entry("lower", joint.lower(), dimension));
  if (joint.has_upper()) StrAppend(&out, ", ", Entry("upper", joint.upper(), dimension));
  StrAppend(&out, "}\n");
}

void WriteDhTable(std::string_view key, const v1::DhTable& table, std::string& out) {
  StrAppend(&out, "  ", key, ":\n");
  for (const v1::DhRow& row : table.rows()) {
    StrAppend(&out, "    - {", Entry("theta", row.theta_rad(), Dimension::kAngle), ", ",
              Entry("d", row.d_m(), Dimension::kLength), ", ",
              Entry("a", row.a_m(), Dimension::kLength), ", ",
              Entry("alpha", row.alpha_rad(), Dimension::kAngle), "}\n");
  }
}

// "{rz_joint: 1}"; the constant is left out when the joint's motion has none.
std::string ElementText(const v1::ElementaryTransform& element) {
  const bool rotates = element.motion() == v1::ElementaryTransform::ROTATION;
  constexpr std::string_view kAxes = "?xyz";
  const std::string stem = StrCat(rotates ? "r" : "t", kAxes.substr(element.axis(), 1));
  std::string joint, constant;
  if (element.has_joint()) joint = StrCat(stem, "_joint: ", element.joint() + 1);
  if (!element.has_joint() || element.constant() != 0) {
    constant = Entry(stem, element.constant(), rotates ? Dimension::kAngle : Dimension::kLength);
  }
  return StrCat("{", joint, joint.empty() || constant.empty() ? "" : ", ", constant, "}");
}

template <class Elements>
void WriteElements(std::string_view key, const Elements& elements, std::string& out) {
  StrAppend(&out, "  ", key, ":\n");
  for (const v1::ElementaryTransform& element : elements) {
    StrAppend(&out, "    - ", ElementText(element), "\n");
  }
}

void WriteGeometry(const v1::Geometry& geometry, std::string& out) {
  StrAppend(&out, "geometry:\n");
  if (geometry.has_standard_dh()) WriteDhTable("standard_dh", geometry.standard_dh(), out);
  if (geometry.has_craig_dh()) WriteDhTable("craig_dh", geometry.craig_dh(), out);
  if (geometry.has_chain()) WriteElements("chain", geometry.chain().elements(), out);
  if (geometry.flange_size() > 0) WriteElements("flange", geometry.flange(), out);
}

// Each joint's offset in the list of its own type, exact in m and rad.
void WriteOffsets(const v1::Nominal& nominal, v1::JointType type, std::string_view key,
                  std::string& out) {
  std::vector<std::string> offsets;
  bool any = false;
  for (int i = 0; i < nominal.joints_size() && i < nominal.joint_map().offset_size(); ++i) {
    const bool of_type = nominal.joints(i).type() == type;
    any = any || of_type;
    offsets.push_back(of_type ? FormatNumber(nominal.joint_map().offset(i)) : "0");
  }
  if (any) StrAppend(&out, "  ", key, ": [", absl::StrJoin(offsets, ", "), "]\n");
}

void WriteJointMap(const v1::Nominal& nominal, std::string& out) {
  const auto& scale = nominal.joint_map().scale();
  const int n = nominal.joints_size();
  StrAppend(&out, "joint_map:\n  scale:\n");
  for (int i = 0; i + n <= scale.size(); i += n) {
    std::vector<std::string> row;
    for (int k = 0; k < n; ++k) row.push_back(FormatNumber(scale[i + k]));
    StrAppend(&out, "    - [", absl::StrJoin(row, ", "), "]\n");
  }
  WriteOffsets(nominal, v1::REVOLUTE, "offset_rad", out);
  WriteOffsets(nominal, v1::PRISMATIC, "offset_m", out);
}

void WriteTool(const v1::Tool& tool, std::string& out) {
  const v1::Pose& pose = tool.pose();
  StrAppend(&out, "  ", YamlText(tool.name()), ": {", Entry("x", pose.x_m(), Dimension::kLength),
            ", ", Entry("y", pose.y_m(), Dimension::kLength), ", ",
            Entry("z", pose.z_m(), Dimension::kLength), ", qx: ", FormatNumber(pose.qx()),
            ", qy: ", FormatNumber(pose.qy()), ", qz: ", FormatNumber(pose.qz()),
            ", qw: ", FormatNumber(pose.qw()), "}\n");
}

void WriteMass(const v1::LinkMass& mass, std::string& out) {
  StrAppend(&out, "  - {joint: ", mass.joint() + 1, ", mass_kg: ", FormatNumber(mass.mass_kg()),
            ", ", EntryOfPosition("center", mass.x_m(), mass.y_m(), mass.z_m()), "}\n");
}

}  // namespace

std::string WriteRobotFile(const RobotFile& file) {
  const v1::Nominal& nominal = file.nominal;
  std::string out;
  WriteIdentity(file, out);
  StrAppend(&out, "joints:\n");
  for (const v1::Joint& joint : nominal.joints()) WriteJoint(joint, out);
  WriteGeometry(nominal.geometry(), out);
  if (nominal.has_joint_map()) WriteJointMap(nominal, out);
  if (nominal.tools_size() > 0) StrAppend(&out, "tools:\n");
  for (const v1::Tool& tool : nominal.tools()) WriteTool(tool, out);
  if (nominal.masses_size() > 0) StrAppend(&out, "masses:\n");
  for (const v1::LinkMass& mass : nominal.masses()) WriteMass(mass, out);
  return out;
}

}  // namespace truepose::formats
