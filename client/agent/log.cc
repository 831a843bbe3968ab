#include "client/agent/log.h"

#include "absl/strings/str_format.h"
#include "spdlog/sinks/stdout_sinks.h"
#include "spdlog/spdlog.h"

namespace truepose::agent {
namespace {

spdlog::logger& Logger() {
  static const auto logger = [] {
    auto made = spdlog::stderr_logger_mt("truepose-agent");
    made->set_pattern(R"({"time":"%Y-%m-%dT%H:%M:%S.%e%z","level":"%l","message":"%v"})");
    return made;
  }();
  return *logger;
}

}  // namespace

std::string EscapeJson(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out.append({'\\', c});
    } else if (c == '\n') {
      out += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20) {
      absl::StrAppendFormat(&out, "\\u%04x", static_cast<unsigned>(c));
    } else {
      out.push_back(c);
    }
  }
  return out;
}

void SetLogLevel(const std::string& level) {
  const spdlog::level::level_enum parsed = spdlog::level::from_str(level);
  Logger().set_level(parsed == spdlog::level::off ? spdlog::level::info : parsed);
}

void LogDebug(const std::string& message) { Logger().debug(EscapeJson(message)); }
void LogInfo(const std::string& message) { Logger().info(EscapeJson(message)); }
void LogWarning(const std::string& message) { Logger().warn(EscapeJson(message)); }
void LogError(const std::string& message) { Logger().error(EscapeJson(message)); }

}  // namespace truepose::agent
