#include "server/command_line.h"

#include "CLI/CLI.hpp"
#include "server/exit_codes.h"

namespace truepose::server {
namespace {

constexpr char kFooter[] =
    "Stops on SIGTERM or SIGINT: finishes calls under way, puts running jobs back into the queue, "
    "closes the database.\n"
    "Exit codes: 0 stopped, 2 usage, 4 address not free, 5 database.";

void AddOptions(CLI::App& app, double& drain_seconds, CommandLine* out) {
  ServerOptions& server = out->server;
  app.add_option("--listen", server.listen, "loopback host:port (port 0: any), or unix:path")
      ->capture_default_str();
  app.add_option("--database", server.database, "database file, made when it is not there")
      ->capture_default_str();
  app.add_flag("--dev-open", server.dev_open,
               "ask for no tokens: everybody who can connect is local-dev and may do everything");
  app.add_flag("--bootstrap", server.bootstrap,
               "write a new secret for a first admin, when the tokens of all admins were lost");
  app.add_option("--time-zone", server.time_zone,
                 "IANA name of the plant's zone, such as Europe/Berlin; default: the system's");
  app.add_option("--workers", server.workers, "calibration jobs that run at once")
      ->capture_default_str();
  app.add_option("--drain", drain_seconds, "seconds that calls under way get at the end")
      ->capture_default_str();
  app.add_option("--ready-file", out->ready_file,
                 "file that gets the address once calls are served");
  app.add_option("--log-level", out->log_level)
      ->capture_default_str()
      ->check(CLI::IsMember({"debug", "info", "warning", "error"}));
}

}  // namespace

std::optional<int> ParseCommandLine(int argc, const char* const* argv, CommandLine* out) {
  CLI::App app("trueposed: the Truepose calibration service", "trueposed");
  app.set_version_flag("--version", "trueposed " TRUEPOSE_VERSION);
  app.footer(kFooter);
  double drain_seconds = absl::ToDoubleSeconds(out->server.drain);
  // A script can add an option behind those that it was given.
  app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  AddOptions(app, drain_seconds, out);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? kExitOk : kExitUsage;
  }
  out->server.drain = absl::Seconds(drain_seconds);
  return std::nullopt;
}

}  // namespace truepose::server
