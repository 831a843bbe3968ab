#include "core/chain/chain.h"

#include <algorithm>

namespace truepose {

ElementaryTransform Rotation(Axis axis, double angle_rad) {
  return {Motion::kRotation, axis, angle_rad, -1, -1};
}

ElementaryTransform Translation(Axis axis, double length_m) {
  return {Motion::kTranslation, axis, length_m, -1, -1};
}

int JointCount(const Chain& chain) {
  int count = 0;
  for (const ElementaryTransform& element : chain) count = std::max(count, element.joint + 1);
  return count;
}

int ParameterCount(const Chain& chain) {
  int count = 0;
  for (const ElementaryTransform& element : chain) count = std::max(count, element.parameter + 1);
  return count;
}

Pose Forward(const Chain& chain, const Eigen::VectorXd& q, const Eigen::VectorXd& lambda) {
  return Forward<double>(chain, q.data(), lambda.data());
}

Eigen::Matrix<double, 6, 1> ScrewOf(const ElementaryTransform& element, const Pose& X) {
  const Eigen::Vector3d u = X.R.col(static_cast<int>(element.axis));
  Eigen::Matrix<double, 6, 1> screw;
  if (element.motion == Motion::kRotation) {
    screw << X.p.cross(u), u;
  } else {
    screw << u, Eigen::Vector3d::Zero();
  }
  return screw;
}

Eigen::Matrix<double, 6, 1> TwistAt(const Eigen::Vector3d& p,
                                    const Eigen::Matrix<double, 6, 1>& twist_0) {
  Eigen::Matrix<double, 6, 1> twist = twist_0;
  twist.head<3>() += twist_0.tail<3>().cross(p);
  return twist;
}

void RunSweep(const Chain& chain, const double* q, const double* lambda, Sweep* sweep) {
  sweep->X_0E = Pose{};
  sweep->J_joints.setZero(6, JointCount(chain));
  sweep->J_parameters.setZero(6, ParameterCount(chain));
  for (const ElementaryTransform& element : chain) {
    if (element.joint >= 0) sweep->J_joints.col(element.joint) += ScrewOf(element, sweep->X_0E);
    if (element.parameter >= 0)
      sweep->J_parameters.col(element.parameter) += ScrewOf(element, sweep->X_0E);
    Apply(element.motion, element.axis, ValueOf(element, q, lambda), &sweep->X_0E);
  }
}

}  // namespace truepose
