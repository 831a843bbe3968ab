// trueposed: the calibration service. Options and exit codes are in docs/operations.md.
#include <pthread.h>
#include <signal.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>

#include "absl/status/status.h"
#include "core/base/fault.h"
#include "server/calibration_runner.h"
#include "server/command_line.h"
#include "server/exit_codes.h"
#include "server/rpc/log.h"
#include "server/server.h"

namespace truepose::server {
namespace {

// The codes of Server::Start are chosen so that each means one thing here.
ExitCode ToExitCode(const absl::Status& status) {
  if (absl::IsInvalidArgument(status)) return kExitUsage;
  if (absl::IsUnavailable(status)) return kExitUnavailable;
  return kExitDatabase;
}

// Signals are taken by one thread that waits for them, so they are blocked in all; threads inherit
// that.
sigset_t BlockStopSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  signal(SIGPIPE, SIG_IGN);
  return signals;
}

// Whoever waits for the file sees it whole or not at all.
bool WriteReadyFile(const std::string& path, const std::string& address) {
  const std::string temporary = path + ".new";
  {
    std::ofstream file(temporary);
    file << address << "\n";
    if (!file.flush()) return false;
  }
  return std::rename(temporary.c_str(), path.c_str()) == 0;
}

int Fail(ExitCode code, const std::string& message) {
  std::cerr << "trueposed: " << message << "\n";
  return code;
}

void SayWhoMayCall(const ServerOptions& options, const Server& server) {
  if (options.dev_open)
    rpc::LogWarning("--dev-open: no tokens, everybody who can connect is local-dev and an admin");
  const std::string file = server.bootstrap_file();
  if (!file.empty())
    rpc::LogWarning("no admin yet: `truepose admin bootstrap " + file + " --principal NAME`");
}

int Run(const CommandLine& line) {
  const sigset_t signals = BlockStopSignals();
  // One that a killed server left behind would send clients to where nobody is.
  if (!line.ready_file.empty()) std::remove(line.ready_file.c_str());
  auto server = Server::Start(line.server, RealRunners());
  if (!server.ok())
    return Fail(ToExitCode(server.status()), std::string(server.status().message()));
  if (!line.ready_file.empty() && !WriteReadyFile(line.ready_file, (*server)->address())) {
    return Fail(kExitUsage, "ready-file: '" + line.ready_file + "' can't be written");
  }
  rpc::LogInfo("listening at " + (*server)->address() + ", database " + line.server.database);
  SayWhoMayCall(line.server, **server);
  int signal_number = 0;
  sigwait(&signals, &signal_number);
  rpc::LogInfo("stopping: calls under way are finished, running jobs go back to the queue");
  // A second signal ends the process at once, as it would by default.
  pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  (*server)->Stop();
  server->reset();
  if (!line.ready_file.empty()) std::remove(line.ready_file.c_str());
  rpc::LogInfo("stopped");
  return kExitOk;
}

}  // namespace
}  // namespace truepose::server

int main(int argc, char** argv) {
  using namespace truepose::server;
  CommandLine line;
  if (const auto exit_code = ParseCommandLine(argc, argv, &line); exit_code.has_value())
    return *exit_code;
  truepose::rpc::SetLogLevel(line.log_level);
  return Run(line);
}
