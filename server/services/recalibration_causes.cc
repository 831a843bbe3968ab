#include "server/services/recalibration_causes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "server/services/recalibration_rules.h"
#include "server/services/stored_resources.h"
#include "server/store/calibrations.h"
#include "server/store/release.h"
#include "server/store/robots.h"
#include "server/store/sessions.h"

namespace truepose::services {
namespace {

using store::Snapshot;
using Cause = std::optional<NewRequest>;

// What the active calibration was measured with.
struct Active {
  absl::Time activated;
  absl::Time measured = absl::InfinitePast();  // its last session was sealed
  std::vector<double> temperatures_c;          // of the sessions that have one
};

absl::StatusOr<std::optional<Active>> ActiveOf(Snapshot& snapshot, const std::string& robot_name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot, store::GetRobot(snapshot, robot_name));
  const std::string& name = robot.active_calibration();
  if (robot.has_delete_time() || name.empty()) return std::optional<Active>();
  TRUEPOSE_ASSIGN_OR_RETURN(const auto activated, store::ActivationTime(snapshot, name));
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Calibration calibration,
                            store::GetCalibration(snapshot, name));
  Active active{.activated = activated.value_or(absl::InfinitePast()), .temperatures_c = {}};
  for (const std::string& session_name : calibration.sessions()) {
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::Session session, store::GetSession(snapshot, session_name));
    active.measured = std::max(active.measured, store::ToTime(session.seal_time()));
    if (session.has_temperature_c()) active.temperatures_c.push_back(session.temperature_c());
  }
  return std::optional(std::move(active));
}

double Mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// Temperatures at which the robot is in order, or at which somebody was told already.
absl::StatusOr<std::vector<double>> KnownTemperatures(Snapshot& snapshot, const std::string& robot,
                                                      const Active& active) {
  std::vector<double> known = {Mean(active.temperatures_c)};
  TRUEPOSE_ASSIGN_OR_RETURN(const auto requests,
                            AllOfRobot<v1::RecalibrationRequest>(snapshot, robot));
  for (const v1::RecalibrationRequest& request : requests) {
    if (request.cause() != v1::CAUSE_TEMPERATURE ||
        store::ToTime(request.create_time()) < active.activated)
      continue;
    TRUEPOSE_ASSIGN_OR_RETURN(const auto event,
                              GetResource<v1::RobotEvent>(snapshot, request.raised_by()));
    known.push_back(event.temperature_c());
  }
  return known;
}

double LeastDistance(const std::vector<double>& values, double from) {
  double least = HUGE_VAL;
  for (double value : values) least = std::min(least, std::abs(value - from));
  return least;
}

std::string EventText(const v1::RobotEvent& event) {
  std::string text = v1::RobotEventKind_Name(event.kind());
  if (event.joint() > 0) absl::StrAppend(&text, " of joint ", event.joint());
  if (!event.description().empty()) absl::StrAppend(&text, ": ", event.description());
  return text;
}

bool Names(const v1::RecalibrationPolicy& policy, v1::RobotEventKind kind) {
  const auto& kinds = policy.event_kinds();
  return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

absl::StatusOr<Cause> CauseOfTemperature(Snapshot& snapshot, const std::string& robot,
                                         const v1::RobotEvent& event,
                                         const v1::RecalibrationPolicy& policy,
                                         const Active& active) {
  const double step_k = policy.temperature_step_k();
  if (step_k <= 0.0 || event.kind() != v1::TEMPERATURE || active.temperatures_c.empty())
    return Cause();
  TRUEPOSE_ASSIGN_OR_RETURN(const auto known, KnownTemperatures(snapshot, robot, active));
  if (LeastDistance(known, event.temperature_c()) < step_k) return Cause();
  NewRequest request{.robot = robot, .id = "", .cause = v1::CAUSE_TEMPERATURE};
  request.raised_by = event.name();
  request.reason = absl::StrFormat("%.1f C at the robot, %.1f C when it was calibrated",
                                   event.temperature_c(), known.front());
  return Cause(std::move(request));
}

Cause CauseOfKind(const std::string& robot, const v1::RobotEvent& event,
                  const v1::RecalibrationPolicy& policy) {
  if (!Names(policy, event.kind())) return Cause();
  NewRequest request{.robot = robot, .id = "", .cause = v1::CAUSE_EVENT};
  request.raised_by = event.name();
  request.reason = EventText(event);
  return Cause(std::move(request));
}

absl::StatusOr<bool> WasOpenSince(Snapshot& snapshot, const std::string& robot, absl::Time time) {
  TRUEPOSE_ASSIGN_OR_RETURN(const auto requests,
                            AllOfRobot<v1::RecalibrationRequest>(snapshot, robot));
  for (const v1::RecalibrationRequest& request : requests) {
    if (IsOpen(request.state()) || store::ToTime(request.update_time()) >= time) return true;
  }
  return false;
}

std::string RobotOf(const v1::RecalibrationPolicy& policy) {
  return policy.name().substr(0, policy.name().find("/recalibrationPolicies/"));
}

}  // namespace

absl::StatusOr<Cause> CauseOfEvent(Snapshot& snapshot, const std::string& robot,
                                   const v1::RobotEvent& event, absl::Time now) {
  TRUEPOSE_ASSIGN_OR_RETURN(const auto policies,
                            AllOfRobot<v1::RecalibrationPolicy>(snapshot, robot));
  if (policies.empty()) return Cause();
  TRUEPOSE_ASSIGN_OR_RETURN(const auto active, ActiveOf(snapshot, robot));
  const absl::Time happened = event.has_event_time() ? store::ToTime(event.event_time()) : now;
  if (!active.has_value() || happened <= active->measured) return Cause();
  for (const v1::RecalibrationPolicy& policy : policies) {
    if (Cause cause = CauseOfKind(robot, event, policy); cause.has_value()) return cause;
    TRUEPOSE_ASSIGN_OR_RETURN(Cause cause,
                              CauseOfTemperature(snapshot, robot, event, policy, *active));
    if (cause.has_value()) return cause;
  }
  return Cause();
}

absl::StatusOr<Cause> CauseOfCheck(Snapshot& snapshot, const std::string& robot,
                                   const v1::DriftCheck& check) {
  if (!check.limit_exceeded()) return Cause();
  TRUEPOSE_ASSIGN_OR_RETURN(const auto policies,
                            AllOfRobot<v1::RecalibrationPolicy>(snapshot, robot));
  const bool asked =
      policies.empty() || std::any_of(policies.begin(), policies.end(),
                                      [](const auto& policy) { return policy.on_failed_check(); });
  if (!asked) return Cause();
  NewRequest request{.robot = robot, .id = "", .cause = v1::CAUSE_FAILED_CHECK};
  request.raised_by = check.name();
  request.reason = absl::StrFormat("a drift check found an RMS of %.3f mm, the limit is %.3f mm",
                                   check.position_mm().rms(), check.limit_mm());
  if (!check.attributed_to().empty())
    absl::StrAppend(&request.reason, "; it points to ", check.attributed_to());
  return Cause(std::move(request));
}

absl::StatusOr<Cause> CauseOfInterval(Snapshot& snapshot, const v1::RecalibrationPolicy& policy,
                                      absl::Time now) {
  if (!policy.has_interval()) return Cause();
  const std::string robot_name = RobotOf(policy);
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot, store::GetRobot(snapshot, robot_name));
  if (robot.has_delete_time() || robot.active_calibration().empty()) return Cause();
  TRUEPOSE_ASSIGN_OR_RETURN(const auto activated,
                            store::ActivationTime(snapshot, robot.active_calibration()));
  const absl::Duration interval = store::ToDuration(policy.interval());
  if (!activated.has_value() || now - *activated < interval) return Cause();
  const absl::Time due = *activated + absl::Floor(now - *activated, interval);
  TRUEPOSE_ASSIGN_OR_RETURN(const bool seen, WasOpenSince(snapshot, robot_name, due));
  if (seen) return Cause();
  NewRequest request{.robot = robot_name, .id = "", .cause = v1::CAUSE_INTERVAL};
  request.raised_by = policy.name();
  request.reason = absl::StrCat("the interval of ", policy.name(), " is over since ",
                                absl::FormatTime(due, absl::UTCTimeZone()));
  return Cause(std::move(request));
}

}  // namespace truepose::services
