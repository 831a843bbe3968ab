// What an agent is told.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace truepose::agent {

struct RobotSettings {
  std::string name;  // robots/{robot}
  int joints = 0;
};

// A [[source]] table, for who makes the sources (sources.h).
struct SourceSettings {
  std::string kind;                           // such as "csv"
  std::string robot;                          // robots/{robot}, one of the configuration
  int joints = 0;                             // of that robot
  std::map<std::string, std::string> values;  // its other keys; numbers and true or false as text
  std::string place;                          // "agent.toml:17: source[0]", for faults
};

struct AgentConfig {
  std::string agent;       // its name, [a-z0-9][a-z0-9-]{0,62}
  std::string server;      // client/address.h
  std::string token_file;  // "" = client/token_file.h finds one
  std::string spool;       // folder
  int64_t spool_limit_mb = 1024;
  int64_t keep_days = 7;                        // done sessions, after their seal
  std::string listen = "127.0.0.1:7900";        // of the TCP interface; "" = none
  std::vector<std::string> allowed_peers;       // addresses that may connect, besides loopback
  int64_t largest_clock_difference_s = 86'400;  // of a reading's time from this PC's; 0 = any
  bool acknowledge = true;                      // requests are taken on without a person
  std::string log_level = "info";
  std::vector<RobotSettings> robots;
  std::vector<SourceSettings> sources;
};

}  // namespace truepose::agent
