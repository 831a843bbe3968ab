#include "core/robot/robot.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"

namespace truepose {
namespace {

// Angle below which two axes count as parallel; nominal tables give angles to 1e-3 deg at best.
constexpr double kParallel = 1e-6;

const char* Name(JointType type) { return type == JointType::kRevolute ? "revolute" : "prismatic"; }

void CheckJoints(const std::vector<Joint>& joints, FaultList* faults) {
  if (joints.empty()) faults->Add("joints", "none", "at least one joint");
  for (size_t i = 0; i < joints.size(); ++i) {
    if (!(joints[i].lower < joints[i].upper)) {
      faults->Add(absl::StrCat("joints[", i, "].lower"), absl::StrCat(joints[i].lower),
                  absl::StrCat("less than the upper limit ", joints[i].upper));
    }
  }
}

void CheckElement(const ElementaryTransform& element, const std::vector<Joint>& joints,
                  size_t index, int* next, FaultList* faults) {
  const std::string field = absl::StrCat("geometry.chain.elements[", index, "]");
  if (!std::isfinite(element.constant))
    faults->Add(field, absl::StrCat(element.constant), "a finite number");
  if (element.joint < 0) return;
  if (element.joint != *next) {
    faults->Add(field, absl::StrCat("joint ", element.joint + 1),
                absl::StrCat("joint ", *next + 1, ", each once and from base to flange"));
  }
  ++*next;
  if (element.joint >= static_cast<int>(joints.size())) return;
  const JointType type = joints[element.joint].type;
  if ((type == JointType::kRevolute) != (element.motion == Motion::kRotation)) {
    faults->Add(field, element.motion == Motion::kRotation ? "a rotation" : "a translation",
                absl::StrCat("the motion of ", Name(type), " joint ", joints[element.joint].name));
  }
}

void CheckChain(const Chain& chain, const std::vector<Joint>& joints, FaultList* faults) {
  int next = 0;
  for (size_t i = 0; i < chain.size(); ++i) CheckElement(chain[i], joints, i, &next, faults);
  if (next != static_cast<int>(joints.size())) {
    faults->Add("geometry", absl::StrCat(next, " joint motions"),
                absl::StrCat(joints.size(), ", one for each joint"));
  }
}

void CheckMap(const JointMap& map, int joints, FaultList* faults) {
  if (map.scale.rows() != joints || map.scale.cols() != joints) {
    faults->Add("joint_map.scale", absl::StrCat(map.scale.rows(), " x ", map.scale.cols()),
                absl::StrCat(joints, " x ", joints));
  } else if (!map.scale.allFinite() ||
             !Eigen::FullPivLU<Eigen::MatrixXd>(map.scale).isInvertible()) {
    faults->Add("joint_map.scale", "a matrix that can't be inverted",
                "an invertible matrix of finite numbers");
  }
  if (map.offset.size() != joints || !map.offset.allFinite()) {
    faults->Add("joint_map.offset", absl::StrCat(map.offset.size(), " values"),
                absl::StrCat(joints, " finite values"));
  }
}

void CheckMasses(const std::vector<LinkMass>& masses, int joints, FaultList* faults) {
  for (size_t i = 0; i < masses.size(); ++i) {
    if (masses[i].joint < 0 || masses[i].joint >= joints) {
      faults->Add(absl::StrCat("masses[", i, "].joint"), absl::StrCat(masses[i].joint),
                  absl::StrCat("a joint from 0 to ", joints - 1));
    }
  }
}

// Axes in B with all joints at zero: only rotations between two prismatic joints decide, and there
// are none that move.
void CheckParallelPrismatic(const Chain& chain, const std::vector<Joint>& joints,
                            FaultList* faults) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(joints.size());
  Sweep sweep;
  RunSweep(chain, zero.data(), nullptr, &sweep);
  for (size_t i = 1; i < joints.size(); ++i) {
    if (joints[i - 1].type != JointType::kPrismatic || joints[i].type != JointType::kPrismatic)
      continue;
    const Eigen::Vector3d a = sweep.J_joints.col(i - 1).head<3>(),
                          b = sweep.J_joints.col(i).head<3>();
    if (a.cross(b).norm() > kParallel) continue;
    faults->Add(
        absl::StrCat("joints[", i, "]"),
        absl::StrCat("prismatic joint ", joints[i].name, " parallel to prismatic joint ",
                     joints[i - 1].name),
        "consecutive prismatic joints that are not parallel: parallel ones can't be told apart");
  }
}

}  // namespace

JointMap JointMap::Identity(int joints) {
  return {Eigen::MatrixXd::Identity(joints, joints), Eigen::VectorXd::Zero(joints)};
}

Eigen::VectorXd JointMap::ToController(const Eigen::VectorXd& q_chain) const {
  return scale.partialPivLu().solve(q_chain - offset);
}

Robot::Robot(std::vector<Joint> joints, Chain chain, JointMap map, std::vector<LinkMass> masses)
    : joints_(std::move(joints)),
      chain_(std::move(chain)),
      map_(std::move(map)),
      masses_(std::move(masses)) {}

absl::StatusOr<Robot> Robot::Create(std::vector<Joint> joints, Chain chain, JointMap map,
                                    std::vector<LinkMass> masses) {
  FaultList faults;
  CheckJoints(joints, &faults);
  CheckChain(chain, joints, &faults);
  CheckMap(map, static_cast<int>(joints.size()), &faults);
  CheckMasses(masses, static_cast<int>(joints.size()), &faults);
  if (faults.empty()) CheckParallelPrismatic(chain, joints, &faults);
  if (!faults.empty()) return faults.ToStatus();
  return Robot(std::move(joints), std::move(chain), std::move(map), std::move(masses));
}

Eigen::VectorXd Robot::MiddleOfLimits() const {
  Eigen::VectorXd middle(joint_count());
  for (int i = 0; i < joint_count(); ++i) {
    const double m = 0.5 * (joints_[i].lower + joints_[i].upper);
    middle(i) = std::isfinite(m) ? m : std::clamp(0.0, joints_[i].lower, joints_[i].upper);
  }
  return middle;
}

Pose NominalForward(const Robot& robot, const Eigen::VectorXd& q_controller) {
  return Forward<double>(robot.chain(), robot.joint_map().ToChain(q_controller).data(), nullptr);
}

}  // namespace truepose
