// The server's log: lines on stderr with time and level. From any thread.
#pragma once

#include <string>

namespace truepose::rpc {

// debug, info, warning or error; anything else is info.
void SetLogLevel(const std::string& level);
void LogDebug(const std::string& message);
void LogInfo(const std::string& message);
void LogWarning(const std::string& message);
void LogError(const std::string& message);

}  // namespace truepose::rpc
