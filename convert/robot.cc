#include "convert/robot.h"

#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "convert/frames.h"
#include "convert/run.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/robot/dh.h"

namespace truepose::convert {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLargestMass_kg = 1e6;  // far above any arm: a slip of units

std::vector<Joint> JointsFrom(const v1::Nominal& nominal, FaultList* faults) {
  std::vector<Joint> joints;
  std::set<std::string> names;
  for (int i = 0; i < nominal.joints_size(); ++i) {
    const v1::Joint& joint = nominal.joints(i);
    const std::string field = absl::StrCat("joints[", i, "]");
    if (joint.name().empty()) faults->Add(field + ".name", "an empty name", "a name");
    if (!names.insert(joint.name()).second)
      faults->Add(field + ".name", absl::StrCat("'", joint.name(), "' again"), "a name of its own");
    if (joint.type() != v1::REVOLUTE && joint.type() != v1::PRISMATIC) {
      faults->Add(field + ".type", absl::StrCat(static_cast<int>(joint.type())),
                  "REVOLUTE or PRISMATIC");
    }
    joints.push_back({joint.name(),
                      joint.type() == v1::PRISMATIC ? JointType::kPrismatic : JointType::kRevolute,
                      joint.has_lower() ? joint.lower() : -kInfinity,
                      joint.has_upper() ? joint.upper() : kInfinity});
  }
  return joints;
}

ElementaryTransform ElementFrom(const v1::ElementaryTransform& message, const std::string& field,
                                bool joint_allowed, FaultList* faults) {
  if (message.motion() == v1::ElementaryTransform::MOTION_UNSPECIFIED ||
      message.axis() == v1::AXIS_UNSPECIFIED ||
      message.motion() > v1::ElementaryTransform::TRANSLATION || message.axis() > v1::Z) {
    faults->Add(field, "no motion or axis", "ROTATION or TRANSLATION with X, Y or Z");
  }
  if (message.has_joint() && !joint_allowed)
    faults->Add(field + ".joint", "a joint", "constants only");
  if (message.has_joint() && message.joint() < 0)
    faults->Add(field + ".joint", absl::StrCat(message.joint()), "a joint from 0");
  CheckSize(message.constant(), kLargestLength_m, field + ".constant", faults);
  const bool rotation = message.motion() == v1::ElementaryTransform::ROTATION;
  return {rotation ? Motion::kRotation : Motion::kTranslation,
          static_cast<Axis>(std::max(0, message.axis() - 1)), message.constant(),
          message.has_joint() ? message.joint() : -1, -1};
}

std::vector<DhRow> RowsFrom(const v1::DhTable& table, const std::string& field, int joints,
                            FaultList* faults) {
  if (table.rows_size() != joints) {
    faults->Add(field + ".rows", absl::StrCat(table.rows_size(), " rows"),
                absl::StrCat(joints, ", one for each joint"));
  }
  std::vector<DhRow> rows;
  for (int i = 0; i < table.rows_size(); ++i) {
    const v1::DhRow& row = table.rows(i);
    const std::string path = absl::StrCat(field, ".rows[", i, "]");
    CheckSize(row.theta_rad(), kLargestJoint, path + ".theta_rad", faults);
    CheckSize(row.d_m(), kLargestLength_m, path + ".d_m", faults);
    CheckSize(row.a_m(), kLargestLength_m, path + ".a_m", faults);
    CheckSize(row.alpha_rad(), kLargestJoint, path + ".alpha_rad", faults);
    rows.push_back({row.theta_rad(), row.d_m(), row.a_m(), row.alpha_rad()});
  }
  return rows;
}

Chain ChainFrom(const v1::Geometry& geometry, const std::vector<Joint>& joints, FaultList* faults) {
  std::vector<JointType> types;
  for (const Joint& joint : joints) types.push_back(joint.type);
  const int n = static_cast<int>(joints.size());
  if (geometry.has_chain()) {
    Chain chain;
    for (int i = 0; i < geometry.chain().elements_size(); ++i) {
      chain.push_back(ElementFrom(geometry.chain().elements(i),
                                  absl::StrCat("geometry.chain.elements[", i, "]"), true, faults));
    }
    return chain;
  }
  if (!geometry.has_standard_dh() && !geometry.has_craig_dh()) {
    faults->Add("geometry", "no table", "standard_dh, craig_dh or chain");
    return {};
  }
  const bool standard = geometry.has_standard_dh();
  const std::vector<DhRow> rows =
      RowsFrom(standard ? geometry.standard_dh() : geometry.craig_dh(),
               standard ? "geometry.standard_dh" : "geometry.craig_dh", n, faults);
  if (static_cast<int>(rows.size()) != n) return {};
  return standard ? ChainFromStandardDh(rows, types) : ChainFromCraigDh(rows, types);
}

void AppendFlange(const v1::Geometry& geometry, Chain* chain, FaultList* faults) {
  for (int i = 0; i < geometry.flange_size(); ++i) {
    chain->push_back(
        ElementFrom(geometry.flange(i), absl::StrCat("geometry.flange[", i, "]"), false, faults));
  }
}

JointMap MapFrom(const v1::Nominal& nominal, FaultList* faults) {
  const int n = nominal.joints_size();
  JointMap map = JointMap::Identity(n);
  const v1::JointMap& message = nominal.joint_map();
  if (message.scale_size() != 0 && message.scale_size() != n * n) {
    faults->Add("joint_map.scale", absl::StrCat(message.scale_size(), " values"),
                absl::StrCat(n * n, ", row by row"));
  } else if (message.scale_size() != 0) {
    for (int i = 0; i < n * n; ++i) map.scale(i / n, i % n) = message.scale(i);
  }
  if (message.offset_size() != 0 && message.offset_size() != n) {
    faults->Add("joint_map.offset", absl::StrCat(message.offset_size(), " values"),
                absl::StrCat(n));
  } else if (message.offset_size() != 0) {
    for (int i = 0; i < n; ++i) map.offset(i) = message.offset(i);
  }
  return map;
}

void CheckTools(const v1::Nominal& nominal, FaultList* faults) {
  std::set<std::string> names;
  for (int i = 0; i < nominal.tools_size(); ++i) {
    const std::string field = absl::StrCat("tools[", i, "]");
    if (!names.insert(nominal.tools(i).name()).second) {
      faults->Add(field + ".name", absl::StrCat("'", nominal.tools(i).name(), "' again"),
                  "a name of its own");
    }
    CheckPose(nominal.tools(i).pose(), field + ".pose", faults);
  }
}

void CheckMasses(const v1::Nominal& nominal, FaultList* faults) {
  for (int i = 0; i < nominal.masses_size(); ++i) {
    const v1::LinkMass& mass = nominal.masses(i);
    const std::string field = absl::StrCat("masses[", i, "]");
    if (mass.joint() < 0 || mass.joint() >= nominal.joints_size()) {
      faults->Add(field + ".joint", absl::StrCat(mass.joint()),
                  absl::StrCat("a joint from 0 to ", nominal.joints_size() - 1));
    }
    if (!(mass.mass_kg() >= 0 && mass.mass_kg() <= kLargestMass_kg)) {
      faults->Add(field + ".mass_kg", absl::StrCat(mass.mass_kg()),
                  absl::StrCat("0 to ", kLargestMass_kg));
    }
    CheckSize(mass.x_m(), kLargestLength_m, field + ".x_m", faults);
    CheckSize(mass.y_m(), kLargestLength_m, field + ".y_m", faults);
    CheckSize(mass.z_m(), kLargestLength_m, field + ".z_m", faults);
  }
}

std::vector<LinkMass> MassesFrom(const v1::Nominal& nominal) {
  std::vector<LinkMass> masses;
  for (const v1::LinkMass& mass : nominal.masses())
    masses.push_back({mass.joint(), mass.mass_kg(), {mass.x_m(), mass.y_m(), mass.z_m()}});
  return masses;
}

}  // namespace

absl::StatusOr<Robot> RobotFrom(const v1::Nominal& nominal) {
  FaultList faults;
  std::vector<Joint> joints = JointsFrom(nominal, &faults);
  Chain chain = ChainFrom(nominal.geometry(), joints, &faults);
  AppendFlange(nominal.geometry(), &chain, &faults);
  JointMap map = MapFrom(nominal, &faults);
  CheckTools(nominal, &faults);
  CheckMasses(nominal, &faults);
  if (!faults.empty()) return faults.ToStatus();
  return Robot::Create(std::move(joints), std::move(chain), std::move(map), MassesFrom(nominal));
}

absl::StatusOr<Pose> ToolByName(const v1::Nominal& nominal, const std::string& name,
                                const std::string& field) {
  std::vector<std::string> names;
  for (const v1::Tool& tool : nominal.tools()) {
    if (tool.name() == name) return PoseFrom(tool.pose());
    names.push_back(tool.name());
  }
  return FaultStatus(field, absl::StrCat("tool '", name, "'"),
                     names.empty() ? "a tool of the robot file, which has none"
                                   : absl::StrCat("one of ", absl::StrJoin(names, ", ")));
}

absl::Status ValidateNominal(const v1::Nominal& nominal) { return RobotFrom(nominal).status(); }

}  // namespace truepose::convert
