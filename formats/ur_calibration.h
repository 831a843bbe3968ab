// The calibration file of Universal Robots' ROS packages (ur_robot_driver, ur_description): YAML
//
//   kinematics:
//     shoulder: {x: 0, y: 0, z: 0.1273, roll: 0, pitch: 0, yaw: 0}
//     upper_arm: ...  forearm: ...  wrist_1: ...  wrist_2: ...  wrist_3: ...
//     hash: calib_1234
//
// in m and rad. Each link's six values are the constant origin of its joint in the link before,
// T(x y z) R(z, yaw) R(y, pitch) R(x, roll), the joint then turns about z (joint_origins.h). The
// first is in the frame `base_link_inertia` of ur_description, which is the controller's base frame
// `base`: that is our B. `base_link` is turned against both by pi about z. Behind wrist_3 there is
// nothing: its frame is the flange `tool0` with all joints moved, our F.
#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::formats {

struct UrCalibration {
  v1::Geometry geometry;  // a chain of the form of joint_origins.h, six revolute joints
  std::string hash;       // the driver compares it with the controller's own calibration
};

// Numbers read back as the same bits.
// @returns kInvalidArgument with one fault for a geometry of another form.
absl::StatusOr<std::string> WriteUrCalibration(const UrCalibration& calibration);

// @returns kInvalidArgument with all faults, each with file and line.
absl::StatusOr<UrCalibration> ParseUrCalibration(std::string_view text, std::string_view file_name);

}  // namespace truepose::formats
