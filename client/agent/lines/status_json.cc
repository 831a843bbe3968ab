#include "client/agent/lines/status_json.h"

#include <algorithm>

#include "absl/strings/str_cat.h"

namespace truepose::agent {
namespace {

// Of a spool with more sessions the first are listed; the counts are of all.
constexpr size_t kMostSessions = 100;

Json RobotJson(const RobotStatus& robot) {
  return {{"robot", robot.robot},
          {"joints", robot.joints},
          {"problem", robot.problem},
          {"fault", robot.fault},
          {"active_calibration", robot.active_calibration},
          {"request", robot.request},
          {"released", robot.released},
          {"released_problem", robot.released_problem},
          {"controller_state", robot.controller_state}};
}

}  // namespace

Json ProgressJson(const SessionProgress& progress) {
  return {{"session", progress.session},     {"robot", progress.robot},
          {"readings", progress.readings},   {"sealed", progress.sealed},
          {"delivered", progress.delivered}, {"settled", progress.settled},
          {"refusal", progress.refusal}};
}

Json TaskJson(const MeasuringTask& task) {
  Json poses = Json::array();
  for (const v1::PoseSetPose& pose : task.poses) {
    Json joints = Json::array();
    for (const double joint : pose.joints()) joints.push_back(joint);
    poses.push_back({{"label", pose.label()}, {"joints", joints}});
  }
  return {{"request", task.request},
          {"reason", task.reason},
          {"pose_set", task.pose_set},
          {"session", task.session},
          {"poses", poses}};
}

Json StatusJson(const AgentStatus& status) {
  Json robots = Json::array(), sessions = Json::array();
  for (const RobotStatus& robot : status.robots) robots.push_back(RobotJson(robot));
  for (size_t i = 0; i < std::min(kMostSessions, status.sessions.size()); ++i)
    sessions.push_back(ProgressJson(status.sessions[i]));
  return {{"agent", status.agent},
          {"version", status.version},
          {"server", status.server},
          {"connected", status.connected},
          {"problem", status.problem},
          {"waiting_readings", status.waiting_readings},
          {"spool_bytes", status.spool_bytes},
          {"spool_limit_bytes", status.spool_limit_bytes},
          {"open_sessions", status.sessions.size()},
          {"done_sessions", status.done_sessions},
          {"robots", robots},
          {"sessions", sessions}};
}

std::string MetricsText(const AgentStatus& status) {
  std::string text;
  const auto add = [&](const char* name, const char* type, const char* help, int64_t value) {
    absl::StrAppend(&text, "# HELP truepose_agent_", name, " ", help, "\n# TYPE truepose_agent_",
                    name, " ", type, "\ntruepose_agent_", name, " ", value, "\n");
  };
  const auto refused = std::count_if(status.sessions.begin(), status.sessions.end(),
                                     [](const auto& session) { return !session.refusal.empty(); });
  const auto released = std::count_if(status.robots.begin(), status.robots.end(),
                                      [](const auto& robot) { return !robot.released.empty(); });
  const auto problems =
      std::count_if(status.robots.begin(), status.robots.end(),
                    [](const auto& robot) { return !robot.released_problem.empty(); });
  add("connected", "gauge", "1 while the server answers.", status.connected ? 1 : 0);
  add("waiting_readings", "gauge", "Readings that the server does not have.",
      status.waiting_readings);
  add("spool_bytes", "gauge", "Bytes of the spool.", status.spool_bytes);
  add("spool_limit_bytes", "gauge", "Bytes that the spool may have.", status.spool_limit_bytes);
  add("open_sessions", "gauge", "Sessions that are not sealed on the server.",
      static_cast<int64_t>(status.sessions.size()));
  add("refused_sessions", "gauge", "Sessions that the server refuses.", refused);
  add("released_sets", "gauge", "Robots with a released set.", released);
  add("released_problems", "gauge",
      "Robots whose released set was refused, is damaged or could not be made.", problems);
  add("readings_taken_total", "counter", "Readings taken since the start.", status.taken_readings);
  add("readings_delivered_total", "counter", "Readings acknowledged since the start.",
      status.delivered_readings);
  add("messages_refused_total", "counter", "Messages answered with an error.",
      status.refused_messages);
  add("sessions_reopened_total", "counter", "Done sessions that the server had lost.",
      status.reopened_sessions);
  return text;
}

}  // namespace truepose::agent
