// Poses and vectors between messages and core.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "convert/rules/values.h"
#include "core/geometry/pose.h"
#include "truepose/v1/robot.pb.h"
#include "truepose/v1/session.pb.h"

namespace truepose::convert {

Pose PoseFrom(const v1::Pose& pose);
v1::Pose ToProto(const Pose& pose);
Eigen::Vector3d VectorFrom(const v1::Vector3& vector);
v1::Vector3 ToProto(const Eigen::Vector3d& vector);
Eigen::Matrix3d RotationFrom(const v1::Quaternion& quaternion);
v1::Quaternion QuaternionToProto(const Eigen::Matrix3d& R);

}  // namespace truepose::convert
