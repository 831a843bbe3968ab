// Options of truepose-agent.
#pragma once

#include <optional>
#include <string>

namespace truepose::agent {

struct CommandLine {
  std::string config = "/etc/truepose/agent.toml";
  bool check_config = false;
  std::string ready_file;  // gets the address of the TCP interface once it is served; "" = none
};

// @returns an exit code when the program shall end at once (help, version, usage).
std::optional<int> ParseCommandLine(int argc, const char* const* argv, CommandLine* out);

}  // namespace truepose::agent
