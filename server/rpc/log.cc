#include "server/rpc/log.h"

#include "spdlog/sinks/stdout_sinks.h"
#include "spdlog/spdlog.h"

namespace truepose::rpc {
namespace {

spdlog::logger& Logger() {
  static const auto logger = [] {
    auto made = spdlog::stderr_logger_mt("trueposed");
    made->set_pattern("%Y-%m-%dT%H:%M:%S.%e%z %l %v");
    return made;
  }();
  return *logger;
}

}  // namespace

void SetLogLevel(const std::string& level) {
  const spdlog::level::level_enum parsed = spdlog::level::from_str(level);
  Logger().set_level(parsed == spdlog::level::off ? spdlog::level::info : parsed);
}

void LogDebug(const std::string& message) { Logger().debug(message); }
void LogInfo(const std::string& message) { Logger().info(message); }
void LogWarning(const std::string& message) { Logger().warn(message); }
void LogError(const std::string& message) { Logger().error(message); }

}  // namespace truepose::rpc
