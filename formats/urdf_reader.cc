#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "absl/strings/ascii.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "formats/joint_origins.h"
#include "formats/number.h"
#include "formats/strings.h"
#include "formats/text_file.h"
#include "formats/urdf.h"
#include "formats/urdf_tree.h"
#include "formats/wording.h"

namespace truepose::formats {
namespace {

using Element = v1::ElementaryTransform;

// As of a robot file; the largest arms' have some hundred kilobytes.
constexpr size_t kMostBytes = 1 << 20;
constexpr int kMostJoints = 64;
// rad or m; what stands in files where no limit is meant.
constexpr double kNoLimit = 1e4;

std::string RobotIdOf(const std::string& name) {
  std::string id = AsciiToLower(name);
  for (char& c : id) {
    if (!absl::ascii_isalnum(c)) c = '-';
  }
  id.erase(0, id.find_first_not_of('-'));
  id.resize(std::min<size_t>(id.size(), 63));
  return id.empty() ? "robot" : id;
}

// Not urdf::Rotation::getRPY, which rounds pitch to a quarter turn from 0.26 deg on. Roll is what
// is left behind R(z, yaw), so any yaw of a quarter turn gives the same rotation.
JointOrigin OriginOf(const urdf::Pose& pose) {
  const urdf::Vector3 ex = pose.rotation * urdf::Vector3(1, 0, 0);
  const urdf::Vector3 ey = pose.rotation * urdf::Vector3(0, 1, 0);
  const urdf::Vector3 ez = pose.rotation * urdf::Vector3(0, 0, 1);
  JointOrigin origin{pose.position.x, pose.position.y, pose.position.z};
  origin.yaw = std::atan2(ex.y, ex.x);
  const double c = std::cos(origin.yaw), s = std::sin(origin.yaw);
  origin.pitch = std::atan2(-ex.z, c * ex.x + s * ex.y);
  origin.roll = std::atan2(s * ez.x - c * ez.y, c * ey.y - s * ey.x);
  return origin;
}

double LengthOf(const urdf::Vector3& v) { return std::hypot(v.x, v.y, v.z); }

// x, y or z when the axis is exactly that one.
v1::Axis PlainAxis(const urdf::Vector3& axis) {
  if (axis.x > 0 && axis.y == 0 && axis.z == 0) return v1::X;
  if (axis.x == 0 && axis.y > 0 && axis.z == 0) return v1::Y;
  if (axis.x == 0 && axis.y == 0 && axis.z > 0) return v1::Z;
  return v1::AXIS_UNSPECIFIED;
}

void AppendMotion(v1::JointType type, const urdf::Vector3& axis, int joint, Elements* elements) {
  if (const v1::Axis plain = PlainAxis(axis); plain != v1::AXIS_UNSPECIFIED) {
    AppendJoint(type, joint, elements);
    elements->rbegin()->set_axis(plain);
    return;
  }
  const double azimuth = std::atan2(axis.y, axis.x);
  const double tilt = std::atan2(std::hypot(axis.x, axis.y), axis.z);
  AppendConstant(Element::ROTATION, v1::Z, azimuth, elements);
  AppendConstant(Element::ROTATION, v1::Y, tilt, elements);
  AppendJoint(type, joint, elements);
  AppendConstant(Element::ROTATION, v1::Y, -tilt, elements);
  AppendConstant(Element::ROTATION, v1::Z, -azimuth, elements);
}

bool IsMovable(const urdf::Joint& joint) { return joint.type != urdf::Joint::FIXED; }

const char* ForbiddenType(const urdf::Joint& joint) {
  if (joint.type == urdf::Joint::FLOATING) return "a floating joint";
  if (joint.type == urdf::Joint::PLANAR) return "a planar joint";
  if (joint.type == urdf::Joint::UNKNOWN) return "a joint of unknown type";
  return joint.mimic ? "a joint that mimics another" : nullptr;
}

void SetLimits(const urdf::Joint& from, v1::Joint* joint) {
  if (from.type == urdf::Joint::CONTINUOUS || !from.limits) return;
  const double lower = from.limits->lower, upper = from.limits->upper;
  if (lower == 0 && upper == 0) return;
  if (lower > -kNoLimit) joint->set_lower(lower);
  if (upper < kNoLimit) joint->set_upper(upper);
}

class ChainReader {
 public:
  ChainReader(std::string_view file_name, v1::Nominal* nominal, FaultList* faults)
      : file_name_(file_name), nominal_(*nominal), faults_(*faults) {}

  void Add(const urdf::Joint& joint) {
    AppendOrigin(OriginOf(joint.parent_to_joint_origin_transform), elements());
    if (!IsMovable(joint) || !Check(joint)) return;
    const int index = nominal_.joints_size();
    const bool prismatic = joint.type == urdf::Joint::PRISMATIC;
    v1::Joint* added = nominal_.add_joints();
    added->set_name(joint.name);
    added->set_type(prismatic ? v1::PRISMATIC : v1::REVOLUTE);
    SetLimits(joint, added);
    AppendMotion(added->type(), joint.axis, index, elements());
  }

 private:
  Elements* elements() { return nominal_.mutable_geometry()->mutable_chain()->mutable_elements(); }

  bool Check(const urdf::Joint& joint) {
    const std::string field = StrCat(file_name_, ": joint ", Quoted(joint.name));
    const char* forbidden = ForbiddenType(joint);
    const double length = LengthOf(joint.axis);
    if (forbidden != nullptr) {
      faults_.Add(field, forbidden, "revolute, continuous, prismatic or fixed joints on the chain");
    } else if (!(length > 1e-9 && std::isfinite(length))) {
      faults_.Add(field, StrCat("an axis of length ", FormatNumber(length)), "a direction");
    }
    return forbidden == nullptr && length > 1e-9;
  }

  std::string_view file_name_;
  v1::Nominal& nominal_;
  FaultList& faults_;
};

urdf::Pose Compose(const urdf::Pose& a, const urdf::Pose& b) {
  urdf::Pose c;
  c.rotation = a.rotation * b.rotation;
  c.position = a.rotation * b.position;
  c.position = c.position + a.position;
  return c;
}

// Masses of the links below `base` that a joint of the chain carries.
class MassReader {
 public:
  MassReader(std::string_view file_name, const std::vector<urdf::JointConstSharedPtr>& path,
             v1::Nominal* nominal, FaultList* faults)
      : file_name_(file_name), nominal_(*nominal), faults_(*faults) {
    int index = 0;
    for (const urdf::JointConstSharedPtr& joint : path) {
      if (IsMovable(*joint)) chain_joints_[joint->name] = index++;
    }
  }

  void Run(const urdf::LinkConstSharedPtr& base) {
    std::vector<Placed> open = {{base, urdf::Pose(), -1}};
    while (!open.empty()) {
      const Placed placed = open.back();
      open.pop_back();
      AddMass(placed);
      for (const urdf::JointSharedPtr& joint : placed.link->child_joints) {
        const auto own = chain_joints_.find(joint->name);
        open.push_back({NextLink(*placed.link, *joint),
                        Compose(placed.X_BL, joint->parent_to_joint_origin_transform),
                        own == chain_joints_.end() ? placed.carrier : own->second});
      }
    }
  }

 private:
  struct Placed {
    urdf::LinkConstSharedPtr link;
    urdf::Pose X_BL;  // with all joints at 0
    int carrier;      // joint of the chain, -1 for none
  };

  static urdf::LinkConstSharedPtr NextLink(const urdf::Link& link, const urdf::Joint& joint) {
    for (const urdf::LinkSharedPtr& child : link.child_links) {
      if (child->name == joint.child_link_name) return child;
    }
    return nullptr;  // urdfdom lists a child for each child joint
  }

  void AddMass(const Placed& placed) {
    const urdf::InertialSharedPtr& inertial = placed.link->inertial;
    if (!inertial || placed.carrier < 0 || inertial->mass == 0) return;
    if (!(inertial->mass > 0)) {
      faults_.Add(StrCat(file_name_, ": link ", Quoted(placed.link->name)),
                  StrCat("a mass of ", FormatNumber(inertial->mass)), "at least 0");
    }
    const urdf::Vector3 centre = Compose(placed.X_BL, inertial->origin).position;
    v1::LinkMass* mass = nominal_.add_masses();
    mass->set_joint(placed.carrier);
    mass->set_mass_kg(inertial->mass);
    mass->set_x_m(centre.x);
    mass->set_y_m(centre.y);
    mass->set_z_m(centre.z);
  }

  std::string_view file_name_;
  v1::Nominal& nominal_;
  FaultList& faults_;
  std::map<std::string, int> chain_joints_;
};

}  // namespace

bool LooksLikeXml(std::string_view text) {
  const std::string_view content = WithoutByteOrderMark(text);
  const size_t first = content.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && content[first] == '<';
}

absl::StatusOr<RobotFile> ParseUrdf(std::string_view text, std::string_view file_name,
                                    const UrdfEnds& ends) {
  TRUEPOSE_ASSIGN_OR_RETURN(const urdf::ModelInterfaceSharedPtr model,
                            ParseUrdfTree(WithoutByteOrderMark(text), file_name));
  TRUEPOSE_ASSIGN_OR_RETURN(const UrdfPath path, FindUrdfPath(*model, ends, file_name));
  RobotFile file{RobotIdOf(model->getName()), {}, FieldLines(file_name)};
  file.nominal.set_kind(v1::INDUSTRIAL);
  file.nominal.set_model(model->getName());
  FaultList faults;
  ChainReader chain(file_name, &file.nominal, &faults);
  for (const urdf::JointConstSharedPtr& joint : path.joints) chain.Add(*joint);
  const int joints = file.nominal.joints_size();
  if (faults.empty() && (joints == 0 || joints > kMostJoints)) {
    faults.Add(std::string(file_name), StrCat(joints, " movable joints from base to tip"),
               StrCat("1 to ", kMostJoints));
  }
  MassReader(file_name, path.joints, &file.nominal, &faults).Run(path.base);
  if (!faults.empty()) return faults.ToStatus();
  return file;
}

absl::StatusOr<RobotFile> ReadRobotOrUrdfFile(const std::string& path, const UrdfEnds& ends) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string text, ReadTextFile(path, kMostBytes));
  if (LooksLikeXml(text)) return ParseUrdf(text, path, ends);
  if (!ends.base.empty() || !ends.tip.empty())
    return FaultStatus(path, "a file that is not URDF", "URDF with --urdf-base or --urdf-tip");
  return ParseRobotFile(text, path);
}

}  // namespace truepose::formats
