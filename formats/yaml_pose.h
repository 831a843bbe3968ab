// Rotations in YAML maps, for tools and features.
#pragma once

#include <optional>

#include "formats/rotation.h"
#include "formats/yaml_map.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::formats {

// The unit quaternion of the keys qx, qy, qz, qw; no rotation when there is none of them; nullopt
// after a fault: only some of them, no numbers, a length that is not 1 within 0.001.
std::optional<QuaternionArray> FindQuaternion(YamlMap& map);

// Of the two signs the one with qw >= 0.
void SetRotation(QuaternionArray q, v1::Pose* pose);

}  // namespace truepose::formats
