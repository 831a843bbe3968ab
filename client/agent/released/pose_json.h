// A pose as a JSON object, in the ways in which controllers write it.
#pragma once

#include "client/agent/lines/json_fields.h"
#include "core/geometry/pose.h"

namespace truepose::agent {

// Keys: position_m or position_mm; and one of quaternion [x, y, z, w], rotation_vector [x, y, z]
// in rad, abc_deg [A, B, C]: Rz(A) Ry(B) Rx(C). What is wrong or missing is in the faults of
// `fields`; the pose is then unspecified.
Pose PoseFromJson(JsonFields& fields);

// Joints from `joints` (rad, or m of sliding ones) or `joints_deg`; `size` of them.
std::vector<double> JointsFromJson(JsonFields& fields, size_t size);

}  // namespace truepose::agent
