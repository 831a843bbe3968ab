#include "client/agent/command_line.h"

#include "CLI/CLI.hpp"
#include "client/exit_codes.h"

namespace truepose::agent {
namespace {

constexpr char kFooter[] =
    "Examples:\n"
    "  truepose-agent --config agent.toml --check-config\n"
    "  truepose-agent --config agent.toml\n"
    "  printf '{\"op\":\"status\"}\\n' | nc -N 127.0.0.1 7900\n"
    "  curl http://127.0.0.1:7900/metrics\n"
    "Stops on SIGTERM or SIGINT. Whatever was answered is on the disk, so that any other end is "
    "fine too.\n"
    "Exit codes: 0 stopped, 2 usage, 3 faults of the configuration, 4 address not free, 5 spool "
    "not usable.";

}  // namespace

std::optional<int> ParseCommandLine(int argc, const char* const* argv, CommandLine* out) {
  CLI::App app("truepose-agent: takes readings at the robot and hands them to trueposed",
               "truepose-agent");
  app.set_version_flag("--version", "truepose-agent " TRUEPOSE_VERSION);
  app.footer(kFooter);
  app.add_option("--config", out->config, "configuration file")->capture_default_str();
  app.add_flag("--check-config", out->check_config, "read the configuration, say its faults, end");
  app.add_option("--ready-file", out->ready_file,
                 "file that gets the TCP interface's address once readings are taken");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? client::kExitOk : client::kExitUsage;
  }
  return std::nullopt;
}

}  // namespace truepose::agent
