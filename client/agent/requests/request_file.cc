#include "client/agent/requests/request_file.h"

#include "nlohmann/json.hpp"

namespace truepose::agent {
namespace {

using Json = nlohmann::ordered_json;

v1::RecalibrationState StateOf(const std::string& name) {
  v1::RecalibrationState state = v1::RECALIBRATION_STATE_UNSPECIFIED;
  v1::RecalibrationState_Parse(name, &state);
  return state;
}

v1::RecalibrationCause CauseOf(const std::string& name) {
  v1::RecalibrationCause cause = v1::RECALIBRATION_CAUSE_UNSPECIFIED;
  v1::RecalibrationCause_Parse(name, &cause);
  return cause;
}

Json PosesJson(const std::vector<v1::PoseSetPose>& poses) {
  Json list = Json::array();
  for (const v1::PoseSetPose& pose : poses) {
    Json joints = Json::array();
    for (const double joint : pose.joints()) joints.push_back(joint);
    list.push_back({{"label", pose.label()}, {"joints", joints}});
  }
  return list;
}

OpenRequest FromObject(const Json& json) {
  OpenRequest open;
  open.request.set_name(json.at("request"));
  open.request.set_state(StateOf(json.at("state")));
  open.request.set_cause(CauseOf(json.at("cause")));
  open.request.set_reason(json.at("reason"));
  open.request.set_pose_set(json.at("pose_set"));
  open.session = json.at("session");
  open.decline_reason = json.at("decline_reason");
  open.has_poses = !json.at("poses").is_null();
  if (!open.has_poses) return open;
  for (const Json& pose : json.at("poses")) {
    v1::PoseSetPose& added = open.poses.emplace_back();
    added.set_label(pose.at("label"));
    for (const Json& joint : pose.at("joints")) added.add_joints(joint);
  }
  return open;
}

}  // namespace

std::string ToJson(const OpenRequest& open) {
  const v1::RecalibrationRequest& request = open.request;
  const Json json = {{"request", request.name()},
                     {"state", v1::RecalibrationState_Name(request.state())},
                     {"cause", v1::RecalibrationCause_Name(request.cause())},
                     {"reason", request.reason()},
                     {"pose_set", request.pose_set()},
                     {"poses", open.has_poses ? PosesJson(open.poses) : Json()},
                     {"session", open.session},
                     {"decline_reason", open.decline_reason}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

absl::StatusOr<OpenRequest> OpenRequestFromJson(const std::string& text) {
  try {
    return FromObject(Json::parse(text));
  } catch (const Json::exception& e) {
    return absl::InvalidArgumentError(e.what());
  }
}

}  // namespace truepose::agent
