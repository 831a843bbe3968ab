#include "core/export/home.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "core/base/fault.h"

namespace truepose {
namespace {

constexpr size_t kEffectsShown = 3;

// One fault for all of them: harmonics alone are four numbers a joint, and the cure is the same.
void CheckEffects(const Model& model, const Eigen::VectorXd& lambda, FaultList* faults) {
  std::vector<std::string> names;
  for (const JointEffect& effect : model.effects) {
    if (lambda(effect.parameter) != 0) names.push_back(model.parameters[effect.parameter].name);
  }
  if (names.empty()) return;
  const size_t shown = std::min(names.size(), kEffectsShown);
  faults->Add(
      "effects",
      absl::StrCat(absl::StrJoin(names.begin(), names.begin() + static_cast<long>(shown), ", "),
                   names.size() > shown ? absl::StrCat(" and ", names.size() - shown, " more") : "",
                   " not zero"),
      "geometry alone: calibrate without joint effects to export, what is left of a "
      "calibration with them is not the best geometry");
}

void CheckMap(const JointMap& map, FaultList* faults) {
  const Eigen::MatrixXd signs = map.scale.diagonal().asDiagonal();
  if (map.scale == signs && (map.scale.diagonal().array().abs() == 1).all()) return;
  faults->Add("joint_map.scale", "joints that are coupled or scaled",
              "each chain joint moved by its own controller joint, with scale 1 or -1: this format "
              "has no place for more");
}

JointAxis AxisOf(JointType type, const Eigen::Matrix<double, 6, 1>& screw, double sign) {
  const bool revolute = type == JointType::kRevolute;
  const Eigen::Vector3d u = (revolute ? screw.tail<3>() : screw.head<3>()).normalized();
  JointAxis axis{type, sign * u, Eigen::Vector3d::Zero()};
  if (revolute) axis.p = u.cross(screw.head<3>());
  return axis;
}

}  // namespace

absl::StatusOr<Home> HomeOf(const Robot& robot, const Model& model, const Eigen::VectorXd& lambda,
                            JointSense sense) {
  const bool controller = sense == JointSense::kController;
  const JointMap& map = robot.joint_map();
  FaultList faults;
  CheckEffects(model, lambda, &faults);
  if (controller) CheckMap(map, &faults);
  if (!faults.empty()) return faults.ToStatus();
  const int n = robot.joint_count();
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
  const Eigen::VectorXd& q = controller ? map.offset : zero;
  ModelSweep sweep;
  RunSweep(model, q.data(), lambda.data(), {}, &sweep);
  Home home{{}, sweep.X_BF};
  for (int i = 0; i < n; ++i) {
    home.axes.push_back(
        AxisOf(robot.joints()[i].type, sweep.J_joints.col(i), controller ? map.scale(i, i) : 1));
  }
  return home;
}

}  // namespace truepose
