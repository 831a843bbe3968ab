// The options of trueposed.
#pragma once

#include <optional>
#include <string>

#include "server/server_options.h"

namespace truepose::server {

struct CommandLine {
  ServerOptions server;
  std::string ready_file;          // gets the address once calls are served; removed at the end
  std::string log_level = "info";  // debug, info, warning, error
};

// Prints help, version or what is wrong. @returns the exit code when the program is to end with it.
std::optional<int> ParseCommandLine(int argc, const char* const* argv, CommandLine* out);

}  // namespace truepose::server
