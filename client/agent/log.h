// The agent's log: a JSON object a line on stderr, with time, level and message. From any thread.
#pragma once

#include <string>
#include <string_view>

namespace truepose::agent {

// debug, info, warning or error; anything else is info.
void SetLogLevel(const std::string& level);
void LogDebug(const std::string& message);
void LogInfo(const std::string& message);
void LogWarning(const std::string& message);
void LogError(const std::string& message);

// `text` as it stands between the quotes of a JSON string; bytes that are no ASCII stay.
std::string EscapeJson(std::string_view text);

}  // namespace truepose::agent
