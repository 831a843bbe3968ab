// The open request of a robot as a JSON file, for programs and people, and for the agent's restart.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "truepose/v1/plant.pb.h"
#include "truepose/v1/recalibration.pb.h"

namespace truepose::agent {

struct OpenRequest {
  v1::RecalibrationRequest request;    // as the server said it last
  bool has_poses = false;              // false: not fetched yet
  std::vector<v1::PoseSetPose> poses;  // of request.pose_set
  std::string session;                 // sessions/{uuid} that was begun for it last, "" = none yet
  std::string decline_reason;          // a person has said no; "" = not
};

// Joints in rad or m, each number with all its digits.
std::string ToJson(const OpenRequest& open);
// The reverse, of the request its name, state, cause, reason, pose_set and session.
// @returns kInvalidArgument for what isn't such a file.
absl::StatusOr<OpenRequest> OpenRequestFromJson(const std::string& text);

}  // namespace truepose::agent
