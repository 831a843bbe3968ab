// A geometry as URDF and UR's calibration file have it: before each joint a constant origin, then
// the joint about or along z.
//
// In a message that is a `chain` whose constants before each joint are some of tx, ty, tz, rz, ry,
// rx in this order, and whose joints are rz or tz without a constant: T(x y z) R(z, yaw) R(y,
// pitch) R(x, roll), `xyz` and `rpy` of URDF. The constants behind the last joint are the flange.
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "google/protobuf/repeated_ptr_field.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::formats {

struct JointOrigin {
  double x = 0, y = 0, z = 0;           // m
  double roll = 0, pitch = 0, yaw = 0;  // rad
};

using Elements = google::protobuf::RepeatedPtrField<v1::ElementaryTransform>;

void AppendConstant(v1::ElementaryTransform::Motion motion, v1::Axis axis, double constant,
                    Elements* elements);
// Values that are 0 get no element.
void AppendOrigin(const JointOrigin& origin, Elements* elements);
// The joint about z (revolute) or along z (prismatic).
void AppendJoint(v1::JointType type, int joint, Elements* elements);

// An origin for each joint and one for the flange.
// @returns kInvalidArgument with one fault for a geometry of another form.
absl::StatusOr<std::vector<JointOrigin>> JointOriginsOf(const v1::Geometry& geometry);

}  // namespace truepose::formats
