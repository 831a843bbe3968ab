#include "server/resource/checks.h"

#include <cmath>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "convert/fixture.h"
#include "convert/frames.h"
#include "convert/table_spec.h"
#include "server/store/names.h"
#include "truepose/v1/compensation_table.pb.h"
#include "truepose/v1/plant.pb.h"
#include "truepose/v1/recalibration.pb.h"

namespace truepose::resource {
namespace {

void CheckNotNegative(double value, const char* field, FaultList& faults) {
  if (std::isfinite(value) && value >= 0.0) return;
  const char* const unit = convert::UnitOf(field);
  faults.Add(field, absl::StrCat(value, unit), absl::StrCat("a number of 0", unit, " or more"));
}

void CheckFramePose(const v1::Pose& pose, bool given, FaultList& faults) {
  if (!given) return faults.Add("pose", "nothing", "x_m, y_m, z_m and a unit quaternion");
  convert::CheckPose(pose, "pose", &faults);
}

// Names of plant resources: a prefix and an id.
bool BeginsWith(const std::string& name, const std::string& prefix) {
  return name.size() > prefix.size() && name.starts_with(prefix);
}

// Names of resources of a robot.
bool IsOfRobot(const std::string& name, const std::string& collection) {
  const std::vector<std::string> parts = absl::StrSplit(name, '/');
  return parts.size() == 4 && parts[0] == "robots" && parts[2] == collection && !parts[1].empty() &&
         !parts[3].empty();
}

void CheckJoints(const v1::PoseSet& set, int pose, FaultList& faults) {
  const std::string field = absl::StrCat("poses[", pose, "].joints");
  const auto& joints = set.poses(pose).joints();
  if (joints.size() != set.poses(0).joints_size() || joints.empty()) {
    faults.Add(field, absl::StrCat(joints.size(), " values"),
               "one a joint, equally many in each pose");
  }
  for (int i = 0; i < joints.size(); ++i) {
    if (!std::isfinite(joints[i])) {
      faults.Add(absl::StrCat(field, "[", i, "]"), absl::StrCat(joints[i]), "rad or m");
    }
  }
}

bool IsEarthly(double temperature_c) { return temperature_c >= -60.0 && temperature_c <= 120.0; }

void CheckDuration(const google::protobuf::Duration& duration, const char* field,
                   FaultList& faults) {
  if (duration.seconds() > 0 && duration.nanos() >= 0) return;
  faults.Add(field, absl::StrCat(duration.seconds(), " s"), "more than 0 s");
}

}  // namespace

void CheckNothing(const Message&, FaultList&) {}

void CheckInstrument(const Message& content, FaultList& faults) {
  const auto& instrument = static_cast<const v1::Instrument&>(content);
  CheckNotNegative(instrument.position_sd_m(), "position_sd_m", faults);
  CheckNotNegative(instrument.position_sd_relative(), "position_sd_relative", faults);
  CheckNotNegative(instrument.rotation_sd_rad(), "rotation_sd_rad", faults);
}

void CheckTool(const Message& content, FaultList& faults) {
  const auto& tool = static_cast<const v1::RegisteredTool&>(content);
  CheckFramePose(tool.pose(), tool.has_pose(), faults);
  CheckNotNegative(tool.mass_kg(), "mass_kg", faults);
}

void CheckFixture(const Message& content, FaultList& faults) {
  const auto& fixture = static_cast<const v1::RegisteredFixture&>(content);
  const absl::Status status = convert::ValidateFixture(fixture.fixture());
  if (!status.ok()) faults.AddAll(status, "fixture.");
}

void CheckTarget(const Message& content, FaultList& faults) {
  const auto& target = static_cast<const v1::Target&>(content);
  CheckFramePose(target.pose(), target.has_pose(), faults);
}

void CheckPlacement(const Message& content, FaultList& faults) {
  const auto& placement = static_cast<const v1::Placement&>(content);
  const std::string& stands = placement.instrument();
  if (!BeginsWith(stands, "instruments/") && !BeginsWith(stands, "fixtures/")) {
    faults.Add("instrument", absl::StrCat("'", stands, "'"),
               "instruments/{instrument} or fixtures/{fixture}");
  }
  if (placement.has_pose()) convert::CheckPose(placement.pose(), "pose", &faults);
}

void CheckPoseSet(const Message& content, FaultList& faults) {
  const auto& set = static_cast<const v1::PoseSet&>(content);
  if (set.purpose() == v1::POSE_SET_PURPOSE_UNSPECIFIED) {
    faults.Add("purpose", "nothing", "POSE_SET_CALIBRATE or POSE_SET_CHECK");
  }
  if (set.poses().empty()) faults.Add("poses", "none", "at least one pose");
  for (int i = 0; i < set.poses_size(); ++i) CheckJoints(set, i, faults);
}

void CheckRobotEvent(const Message& content, FaultList& faults) {
  const auto& event = static_cast<const v1::RobotEvent&>(content);
  if (event.kind() == v1::ROBOT_EVENT_KIND_UNSPECIFIED ||
      !v1::RobotEventKind_IsValid(event.kind())) {
    faults.Add("kind", "nothing", "COLLISION, MOTOR_CHANGE, TEMPERATURE, RELOCATION or NOTE");
  }
  if (event.joint() < 0) faults.Add("joint", absl::StrCat(event.joint()), "1 or more, 0 unknown");
  const bool needs_temperature = event.kind() == v1::TEMPERATURE;
  if (needs_temperature && !event.has_temperature_c()) {
    faults.Add("temperature_c", "nothing", "the temperature in degrees Celsius");
  }
  if (event.has_temperature_c() && !IsEarthly(event.temperature_c())) {
    faults.Add("temperature_c", absl::StrCat(event.temperature_c()), "-60 to 120");
  }
}

void CheckRecalibrationPolicy(const Message& content, FaultList& faults) {
  const auto& policy = static_cast<const v1::RecalibrationPolicy&>(content);
  if (policy.has_interval()) CheckDuration(policy.interval(), "interval", faults);
  if (policy.has_expire_after()) CheckDuration(policy.expire_after(), "expire_after", faults);
  CheckNotNegative(policy.temperature_step_k(), "temperature_step_k", faults);
  if (policy.poses() < 0) faults.Add("poses", absl::StrCat(policy.poses()), "0 or more");
  for (int i = 0; i < policy.event_kinds_size(); ++i) {
    const auto kind = policy.event_kinds(i);
    const bool known = kind != v1::ROBOT_EVENT_KIND_UNSPECIFIED && v1::RobotEventKind_IsValid(kind);
    if (known && kind != v1::TEMPERATURE) continue;
    faults.Add(absl::StrCat("event_kinds[", i, "]"), absl::StrCat(static_cast<int>(kind)),
               "COLLISION, MOTOR_CHANGE, RELOCATION or NOTE; of temperature, temperature_step_k");
  }
  if (!policy.pose_set().empty() && !IsOfRobot(policy.pose_set(), "poseSets")) {
    faults.Add("pose_set", absl::StrCat("'", policy.pose_set(), "'"),
               "robots/{robot}/poseSets/{pose_set}, or nothing");
  }
}

void CheckAgentReport(const Message& content, FaultList& faults) {
  const auto& report = static_cast<const v1::AgentReport&>(content);
  faults.AddAll(store::ParseRobotName(report.robot(), "robot").status());
  if (report.spooled_readings() < 0) {
    faults.Add("spooled_readings", absl::StrCat(report.spooled_readings()), "0 or more");
  }
}

void CheckCompensationTable(const Message& content, FaultList& faults) {
  const auto& table = static_cast<const v1::CompensationTable&>(content);
  faults.AddAll(store::ParseCalibrationName(table.calibration(), "calibration").status());
  const absl::Status status = convert::ValidateTableSpec(table.spec());
  if (!status.ok()) faults.AddAll(status, "spec.");
}

}  // namespace truepose::resource
