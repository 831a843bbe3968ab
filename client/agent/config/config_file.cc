#include "client/agent/config/config_file.h"

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "absl/strings/ascii.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "client/address.h"
#include "client/agent/config/toml_table.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

constexpr int64_t kMostJoints = 64;
constexpr char kRobots[] = "robots/";

bool IsId(const std::string& id) {
  if (id.empty() || id.size() > 63 || id.front() == '-') return false;
  for (const char c : id)
    if (!absl::ascii_islower(c) && !absl::ascii_isdigit(c) && c != '-') return false;
  return true;
}

void CheckId(TomlTable& table, const char* key, const std::string& id) {
  if (!id.empty() && !IsId(id))
    table.AddFault(key, absl::StrCat("'", id, "'"), "lower-case letters, digits and -, at most 63");
}

// Of the host only: whether it is loopback is a matter of allowed_peers.
void CheckListen(TomlTable& table, const AgentConfig& config) {
  if (config.listen.empty()) return;
  const size_t colon = config.listen.rfind(':');
  int port = -1;
  const bool has_port = colon != std::string::npos && colon > 0 &&
                        absl::SimpleAtoi(config.listen.substr(colon + 1), &port) && port >= 0 &&
                        port <= 65'535;
  if (!has_port)
    return table.AddFault("listen", absl::StrCat("'", config.listen, "'"),
                          "host:port such as 127.0.0.1:7900, port 0 for any that is free");
  const std::string host = config.listen.substr(0, colon);
  const bool loopback = host.rfind("127.", 0) == 0 || host == "[::1]";
  if (!loopback && config.allowed_peers.empty())
    table.AddFault("listen", absl::StrCat("'", config.listen, "', which others can reach"),
                   "127.0.0.1:port, or allowed_peers with the addresses that may connect");
}

void ReadRobots(TomlTable& root, AgentConfig* config) {
  std::set<std::string> names;
  for (TomlTable& table : root.Tables("robot")) {
    std::string id;
    int64_t joints = 0;
    table.Require({"name", "joints"});
    table.Text("name", &id);
    CheckId(table, "name", id);
    table.Number("joints", 1, kMostJoints, &joints);
    table.RefuseOthers();
    if (!id.empty() && !names.insert(id).second)
      table.AddFault("name", absl::StrCat("'", id, "' again"), "each robot once");
    config->robots.push_back({kRobots + id, static_cast<int>(joints)});
  }
}

void ReadSources(TomlTable& root, AgentConfig* config) {
  for (TomlTable& table : root.Tables("source")) {
    SourceSettings& source = config->sources.emplace_back();
    table.Require({"kind", "robot"});
    table.Text("kind", &source.kind);
    std::string robot;
    table.Text("robot", &robot);
    source.robot = kRobots + robot;
    source.place = table.Place("");
    bool known = robot.empty();
    for (const RobotSettings& settings : config->robots) {
      if (settings.name != source.robot) continue;
      known = true;
      source.joints = settings.joints;
    }
    if (!known) table.AddFault("robot", absl::StrCat("'", robot, "'"), "the name of a [[robot]]");
    for (auto& [key, value] : table.Others()) source.values[key] = value;
  }
}

void ReadLogLevel(TomlTable& root, AgentConfig* config) {
  root.Text("log_level", &config->log_level);
  static const auto& levels = *new std::set<std::string>{"debug", "info", "warning", "error"};
  if (levels.count(config->log_level) == 0)
    root.AddFault("log_level", absl::StrCat("'", config->log_level, "'"),
                  "debug, info, warning or error");
}

void ReadRoot(TomlTable& root, AgentConfig* config) {
  root.Require({"agent", "server", "spool", "robot"});
  root.Text("agent", &config->agent);
  CheckId(root, "agent", config->agent);
  root.Text("server", &config->server);
  const absl::Status address = client::ValidateAddress(config->server);
  if (!config->server.empty() && !address.ok())
    for (const Fault& fault : FaultsOf(address))
      root.AddFault("server", fault.found, fault.expected);
  root.Text("token_file", &config->token_file);
  root.Text("spool", &config->spool);
  root.Number("spool_limit_mb", 1, 1'000'000, &config->spool_limit_mb);
  root.Number("keep_days", 0, 3'650, &config->keep_days);
  root.Text("listen", &config->listen);
  root.Texts("allowed_peers", &config->allowed_peers);
  CheckListen(root, *config);
  root.Number("largest_clock_difference_s", 0, 1'000'000'000, &config->largest_clock_difference_s);
  root.Flag("acknowledge", &config->acknowledge);
  ReadLogLevel(root, config);
  ReadRobots(root, config);
  ReadSources(root, config);
  root.RefuseOthers();
}

void MakeAbsolute(const std::string& config_path, std::string* path) {
  if (path->empty() || path->front() == '/') return;
  const auto folder = std::filesystem::absolute(config_path).parent_path();
  *path = (folder / *path).lexically_normal().string();
}

}  // namespace

absl::StatusOr<AgentConfig> ParseConfig(std::string_view text, const std::string& path) {
  const std::string file = std::filesystem::path(path).filename().string();
  FaultList faults;
  AgentConfig config;
  try {
    const toml::table parsed = toml::parse(text, file);
    TomlTable root(parsed, file, "", faults);
    ReadRoot(root, &config);
  } catch (const toml::parse_error& e) {
    faults.Add(absl::StrCat(file, ":", e.source().begin.line), std::string(e.description()),
               "a TOML file");
  }
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  MakeAbsolute(path, &config.spool);
  MakeAbsolute(path, &config.token_file);
  for (SourceSettings& source : config.sources) {
    const auto of_source = source.values.find("path");
    if (of_source != source.values.end()) MakeAbsolute(path, &of_source->second);
  }
  return config;
}

absl::StatusOr<AgentConfig> ReadConfigFile(const std::string& path) {
  std::ifstream file(path);
  if (!file) return FaultStatus(path, "no file that can be read", "the agent's configuration");
  std::ostringstream text;
  text << file.rdbuf();
  return ParseConfig(text.str(), path);
}

}  // namespace truepose::agent
