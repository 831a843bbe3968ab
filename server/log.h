// The server's log: lines on stderr with time and level.
#pragma once

#include <string>

namespace truepose::server {

// debug, info, warning or error; anything else is info.
void SetLogLevel(const std::string& level);
void LogInfo(const std::string& message);

}  // namespace truepose::server
