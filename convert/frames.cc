#include "convert/frames.h"

#include <cmath>

#include "absl/strings/str_cat.h"

namespace truepose::convert {
namespace {

void CheckUnit(const Eigen::Vector4d& q, const std::string& field, FaultList* faults) {
  if (!q.allFinite()) {
    faults->Add(field, "a value that is not finite", "finite numbers");
  } else if (std::abs(q.norm() - 1) > kUnitTolerance) {
    faults->Add(field, absl::StrCat("a quaternion of length ", q.norm()), "a unit quaternion");
  }
}

Eigen::Matrix3d RotationFrom(double x, double y, double z, double w) {
  return RotationOf<double>(Eigen::Vector4d(x, y, z, w).normalized());
}

}  // namespace

void CheckFinite(double value, const std::string& field, FaultList* faults) {
  if (!std::isfinite(value)) faults->Add(field, absl::StrCat(value), "a finite number");
}

void CheckSize(double value, double largest, const std::string& field, FaultList* faults) {
  if (std::abs(value) <= largest) return;
  faults->Add(field, absl::StrCat(value), absl::StrCat("a finite number of at most ", largest));
}

void CheckVector(const v1::Vector3& vector, const std::string& field, FaultList* faults) {
  CheckSize(vector.x(), kLargestLength_m, field + ".x", faults);
  CheckSize(vector.y(), kLargestLength_m, field + ".y", faults);
  CheckSize(vector.z(), kLargestLength_m, field + ".z", faults);
}

void CheckQuaternion(const v1::Quaternion& q, const std::string& field, FaultList* faults) {
  CheckUnit({q.x(), q.y(), q.z(), q.w()}, field, faults);
}

void CheckPose(const v1::Pose& pose, const std::string& field, FaultList* faults) {
  CheckSize(pose.x_m(), kLargestLength_m, field + ".x_m", faults);
  CheckSize(pose.y_m(), kLargestLength_m, field + ".y_m", faults);
  CheckSize(pose.z_m(), kLargestLength_m, field + ".z_m", faults);
  CheckUnit({pose.qx(), pose.qy(), pose.qz(), pose.qw()}, field, faults);
}

Pose PoseFrom(const v1::Pose& pose) {
  return {RotationFrom(pose.qx(), pose.qy(), pose.qz(), pose.qw()),
          Eigen::Vector3d(pose.x_m(), pose.y_m(), pose.z_m())};
}

v1::Pose ToProto(const Pose& X) {
  v1::Pose pose;
  pose.set_x_m(X.p.x());
  pose.set_y_m(X.p.y());
  pose.set_z_m(X.p.z());
  const Eigen::Vector4d q = QuaternionOf<double>(X.R);
  pose.set_qx(q(0));
  pose.set_qy(q(1));
  pose.set_qz(q(2));
  pose.set_qw(q(3));
  return pose;
}

Eigen::Vector3d VectorFrom(const v1::Vector3& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

v1::Vector3 ToProto(const Eigen::Vector3d& vector) {
  v1::Vector3 message;
  message.set_x(vector.x());
  message.set_y(vector.y());
  message.set_z(vector.z());
  return message;
}

Eigen::Matrix3d RotationFrom(const v1::Quaternion& q) {
  return RotationFrom(q.x(), q.y(), q.z(), q.w());
}

v1::Quaternion QuaternionToProto(const Eigen::Matrix3d& R) {
  const Eigen::Vector4d q = QuaternionOf<double>(R);
  v1::Quaternion message;
  message.set_x(q(0));
  message.set_y(q(1));
  message.set_z(q(2));
  message.set_w(q(3));
  return message;
}

}  // namespace truepose::convert
