#include "client/agent/released/released_lines.h"

#include <algorithm>
#include <numbers>
#include <span>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "client/agent/released/pose_json.h"
#include "compensation/correct_by_table.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

using compensation::Correction;
using compensation::Outcome;
using State = std::shared_ptr<const ReleasedState>;

constexpr double kDegrees = 180 / std::numbers::pi;
constexpr double kMillimetres = 1e3;

std::string WhyNone(const ReleasedState& state) {
  if (!state.problem.empty()) return state.problem;
  return state.waiting.empty() ? "no server has told of one" : state.waiting;
}

// The robot's state, with a set unless `may_be_empty`.
absl::StatusOr<State> StateOf(const ReleasedDesk& desk, JsonFields& fields, bool may_be_empty) {
  std::string robot = fields.Text("robot").value_or("");
  if (robot.empty()) return FaultStatus("robot", "nothing", "a robot's name");
  if (!absl::StartsWith(robot, "robots/")) robot = "robots/" + robot;
  State state = desk.state(robot);
  if (state == nullptr)
    return absl::NotFoundError(absl::StrCat(robot, " is not in this agent's configuration"));
  if (state->current == nullptr && !may_be_empty)
    return absl::FailedPreconditionError(
        absl::StrCat(robot, " has no released set: ", WhyNone(*state)));
  return state;
}

// Why, for who commands the robot.
std::string Reason(const Correction& correction) {
  switch (correction.outcome) {
    case Outcome::kOk:
      return "";
    case Outcome::kNearSingular:
      return "near a singularity: corrected joints would be far from the target's";
    case Outcome::kBeyondLimit:
      return absl::StrCat("the corrected joint ", correction.joint + 1, " is beyond its limit");
    case Outcome::kUnreachable:
      return "no joints bring the flange there";
    case Outcome::kOutsideDomain:
      return absl::StrCat("the target is outside of the table, on its axis ", correction.joint + 1);
    case Outcome::kInvalidArgument:
      break;
  }
  return "a measuring arm, or a number that is none";
}

Json RefusalJson(const Correction& correction, const ReleasedSet& set) {
  return {{"ok", false},
          {"code", "OUT_OF_RANGE"},
          {"outcome", compensation::Name(correction.outcome)},
          {"message", Reason(correction)},
          {"calibration", set.entry().calibration}};
}

void AddAccuracy(const ReleasedSet& set, bool exact, Json& answer) {
  const compensation::TableHeader& header = set.table().header;
  answer["calibration"] = set.entry().calibration;
  if (header.predicted_accuracy_95_m > 0)
    answer["predicted_accuracy_95_mm"] = header.predicted_accuracy_95_m * kMillimetres;
  if (!exact) answer["table_error_mm"] = header.worst.position_m * kMillimetres;
}

Json CorrectionJson(const Correction& correction, const ReleasedSet& set, bool in_degrees,
                    bool exact) {
  if (correction.outcome != Outcome::kOk) return RefusalJson(correction, set);
  Json joints = Json::array();
  const double factor = in_degrees ? kDegrees : 1;
  for (int i = 0; i < set.table().header.joints; ++i) joints.push_back(correction.q[i] * factor);
  Json answer = {{"outcome", "ok"}, {in_degrees ? "joints_deg" : "joints", joints}};
  AddAccuracy(set, exact, answer);
  return answer;
}

// One of the two keys is given, and not null.
bool IsInDegrees(const Json& message) {
  const auto found = message.find("joints_deg");
  return found != message.end() && !found->is_null();
}

Json SetJson(const ReleasedSet& set) {
  const ReleasedEntry& entry = set.entry();
  return {{"calibration", entry.calibration},
          {"table", entry.table},
          {"sha256", entry.sha256},
          {"made_active", TimeText(entry.activated_us)}};
}

// The faults of `object` come as those of `place`.
template <typename Read>
void ReadObject(const Json& object, const std::string& place, FaultList& faults, Read read) {
  if (!object.is_object()) return faults.Add(place, FoundText(object), "an object");
  FaultList own;
  JsonFields fields(object, own);
  read(fields);
  fields.RefuseOthers();
  if (!own.empty()) faults.AddAll(own.ToStatus(), place + ".");
}

std::vector<ReportedPose> PosesOf(JsonFields& fields, int joints, FaultList& faults) {
  std::vector<ReportedPose> poses;
  fields.Ignore("poses");
  const Json list = fields.object().value("poses", Json());
  if (!list.is_array() || list.empty())
    faults.Add("poses", FoundText(list), "a list of joints and reported poses");
  if (!list.is_array()) return poses;
  for (size_t i = 0; i < list.size(); ++i)
    ReadObject(list[i], absl::StrCat("poses[", i, "]"), faults, [&](JsonFields& pose) {
      const auto read = JointsFromJson(pose, static_cast<size_t>(joints));
      poses.push_back({read, PoseFromJson(pose)});
    });
  return poses;
}

void ReadFrames(JsonFields& fields, FaultList& faults, ReadBackOptions* options) {
  fields.Ignore("base");
  fields.Ignore("tool");
  if (!fields.Has("base") && !fields.Has("tool")) return;
  if (fields.Has("base") != fields.Has("tool"))
    return faults.Add(fields.Has("base") ? "tool" : "base", "nothing",
                      "both, or none to have them fitted");
  Frames& frames = options->frames.emplace();
  const auto read = [&](const char* key, Pose* pose) {
    ReadObject(fields.object().at(key), key, faults,
               [&](JsonFields& object) { *pose = PoseFromJson(object); });
  };
  read("base", &frames.X_WB);
  read("tool", &frames.X_FT);
}

void ReadDeviation(JsonFields& fields, const char* key, double unit, double* out) {
  const auto value = fields.Number(key);
  if (!value.has_value()) return;
  if (!(*value > 0)) return fields.AddFault(key, absl::StrCat(*value), "more than 0");
  *out = *value * unit;
}

std::string InWords(const ReadBackResult& result) {
  if (result.controller_state == "unknown")
    return "the controller runs none of the parameters that are known here";
  if (result.controller_state != "undecided")
    return absl::StrFormat(
        "the controller runs %s (%s): %.4f mm",
        result.parameters == "nominal" ? "the nominal parameters" : ShortName(result.parameters),
        result.controller_state, result.fits[0].fit.position_rms_m * 1e3);
  if (result.more_poses > 0) return absl::StrCat("undecided: ", result.more_poses, " more poses");
  return "undecided: at poses like these several can't be told apart; spread them over the work "
         "space";
}

Json ReadBackJson(const ReadBackResult& result) {
  Json fits = Json::array();
  for (const HypothesisFit& one : result.fits)
    fits.push_back({{"parameters", one.parameters},
                    {"state", one.state},
                    {"position_rms_mm", one.fit.position_rms_m * kMillimetres},
                    {"position_largest_mm", one.fit.position_largest_m * kMillimetres},
                    {"rotation_rms_deg", one.fit.rotation_rms_rad * kDegrees}});
  return {{"controller_state", result.controller_state},
          {"parameters", result.parameters},
          {"more_poses", result.more_poses},
          {"message", InWords(result)},
          {"residuals", fits}};
}

}  // namespace

absl::StatusOr<Json> CorrectLine(const ReleasedDesk& desk, const Json& message) {
  FaultList faults;
  JsonFields fields(message, faults);
  fields.Ignore("op");
  TRUEPOSE_ASSIGN_OR_RETURN(const State state, StateOf(desk, fields, false));
  const ReleasedSet& set = *state->current;
  const auto joints = JointsFromJson(fields, static_cast<size_t>(set.table().header.joints));
  const bool exact = fields.Flag("exact").value_or(false);
  fields.RefuseOthers();
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  const Correction correction =
      exact ? compensation::CorrectJoints(set.table().arm, joints.data(), {})
            : compensation::CorrectByTable(set.table(), joints.data());
  return CorrectionJson(correction, set, IsInDegrees(message), exact);
}

absl::StatusOr<Json> ReleasedLine(const ReleasedDesk& desk, const Json& message) {
  FaultList faults;
  JsonFields fields(message, faults);
  fields.Ignore("op");
  TRUEPOSE_ASSIGN_OR_RETURN(const State state, StateOf(desk, fields, true));
  fields.RefuseOthers();
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  Json former = Json::array();
  for (const auto& set : state->former) former.push_back(SetJson(*set));
  Json answer = {{"problem", state->problem},
                 {"waiting", state->waiting},
                 {"controller_state", state->controller_state},
                 {"path", state->path},
                 {"former", former}};
  if (state->current == nullptr) return answer;
  answer.update(SetJson(*state->current));
  AddAccuracy(*state->current, false, answer);
  return answer;
}

absl::StatusOr<Json> ReadBackLine(const ReleasedDesk& desk, const Json& message) {
  FaultList faults;
  JsonFields fields(message, faults);
  fields.Ignore("op");
  TRUEPOSE_ASSIGN_OR_RETURN(const State state, StateOf(desk, fields, false));
  ReadBackOptions options;
  ReadDeviation(fields, "position_sd_mm", 1 / kMillimetres, &options.noise.position_m);
  ReadDeviation(fields, "rotation_sd_deg", 1 / kDegrees, &options.noise.rotation_rad);
  const auto poses = PosesOf(fields, state->current->table().header.joints, faults);
  ReadFrames(fields, faults, &options);
  fields.RefuseOthers();
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  const ReadBackResult result = ReadBack(*state, poses, options);
  if (result.controller_state != "undecided")
    desk.on_read_back(state->current->table().header.robot.c_str(), result.controller_state);
  return ReadBackJson(result);
}

std::map<std::string, std::function<absl::StatusOr<Json>(const Json& message)>> ReleasedOperations(
    const ReleasedDesk& desk) {
  return {{"correct", [desk](const Json& message) { return CorrectLine(desk, message); }},
          {"released", [desk](const Json& message) { return ReleasedLine(desk, message); }},
          {"read_back", [desk](const Json& message) { return ReadBackLine(desk, message); }}};
}

}  // namespace truepose::agent
