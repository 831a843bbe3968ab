// What an agent says of itself.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "client/agent/source.h"

namespace truepose::agent {

struct RobotStatus {
  std::string robot = {};  // robots/{robot}
  int joints = 0;
  std::string problem = {};  // why the server doesn't tell of it, "" = it does
  bool answered = false;     // the server, the last time that it was asked of it
  std::string fault = {};    // of the configuration against the server's robot, "" = none
  std::string active_calibration = {};  // as the server said last, "" = none
  std::string request = {};             // the open one, "" = none
  std::string released = {};            // calibration whose table runs, "" = none
  std::string released_digest = {};     // of that calibration
  std::string released_problem = {};    // what is wrong with what was released, "" = nothing
  std::string controller_state = {};    // by the last read-back, "" = none was made
};

struct AgentStatus {
  std::string agent = {}, version = {}, server = {};
  bool connected = false;
  std::string problem = {};
  int64_t spool_bytes = 0, spool_limit_bytes = 0;
  int64_t waiting_readings = 0;  // that the server doesn't have
  int64_t taken_readings = 0, delivered_readings = 0, refused_messages = 0;  // since the start
  int64_t reopened_sessions = 0;
  int64_t done_sessions = 0;
  std::vector<RobotStatus> robots = {};
  std::vector<SessionProgress> sessions = {};  // that are not done
};

}  // namespace truepose::agent
