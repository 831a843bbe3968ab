#include "convert/frames.h"

namespace truepose::convert {
namespace {

Eigen::Matrix3d RotationFrom(double x, double y, double z, double w) {
  return RotationOf<double>(Eigen::Vector4d(x, y, z, w).normalized());
}

}  // namespace

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
