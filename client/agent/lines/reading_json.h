// A reading as a JSON object, and back to a message.
#pragma once

#include "client/agent/lines/json_fields.h"
#include "truepose/v1/session.pb.h"

namespace truepose::agent {

struct ReadingJsonOptions {
  double now_s = 0;                       // this PC's clock, Unix time
  double largest_clock_difference_s = 0;  // 0 = any
};

// Keys: joints (rad or m by joint type) or joints_deg; joints_commanded, joints_commanded_deg;
// position_m or position_mm; quaternion [x, y, z, w], of length 1 within 0.001; axis; position_sd_m
// or _mm; torques_nm; temperature_c; time (ISO 8601 with offset, or Unix seconds); placement,
// target, group, coordinates, anchor, beam, feature; distance_m or _mm, distance_sd_m or _mm;
// extra. What is wrong is in the faults of `fields`; the reading is then unspecified.
v1::Reading ReadingFromJson(JsonFields& fields, const ReadingJsonOptions& options);

}  // namespace truepose::agent
