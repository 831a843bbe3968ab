// truepose-agent: the shop-floor agent. Configuration and exit codes are in docs/agent.md.
#include <malloc.h>
#include <pthread.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>

#include "client/agent/agent.h"
#include "client/agent/command_line.h"
#include "client/agent/config/config_file.h"
#include "client/agent/log.h"
#include "client/agent/notify.h"
#include "client/agent/sources.h"
#include "client/exit_codes.h"

namespace truepose::agent {
namespace {

using client::ExitCode;

int Fail(ExitCode code, const absl::Status& status) {
  std::cerr << "truepose-agent: " << std::string(status.message()) << "\n";
  return code;
}

ExitCode CodeOf(const absl::Status& status) {
  if (absl::IsInvalidArgument(status)) return client::kExitInput;
  if (absl::IsFailedPrecondition(status)) return client::kExitDatabase;
  return client::kExitUnavailable;
}

// Taken by the main thread, which waits for them; threads inherit the mask. A file that may not
// grow is a disk that is full, not an end of the program.
sigset_t PrepareSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
  return signals;
}

bool WriteReadyFile(const std::string& path, const std::string& address) {
  const std::string temporary = path + ".new";
  std::ofstream file(temporary);
  file << address << "\n";
  file.close();
  return file && std::rename(temporary.c_str(), path.c_str()) == 0;
}

// Tells the watchdog for as long as the agent answers for itself.
void WaitForStop(const sigset_t& signals, const Agent& agent) {
  const auto interval = WatchdogInterval();
  const timespec wait{interval.count() / 1000, interval.count() % 1000 * 1'000'000};
  while (true) {
    if (interval.count() == 0) {
      int number = 0;
      sigwait(&signals, &number);
      return;
    }
    if (sigtimedwait(&signals, nullptr, &wait) >= 0) return;
    agent.Status();
    NotifySystemd("WATCHDOG=1");
  }
}

int Serve(const CommandLine& line, const AgentConfig& config,
          std::vector<std::unique_ptr<Source>> sources) {
  const sigset_t signals = PrepareSignals();
  // Each thread's own heap would cost more than waiting for one another.
  mallopt(M_ARENA_MAX, 2);
  if (!line.ready_file.empty()) std::remove(line.ready_file.c_str());
  auto agent = Agent::Start(config, std::move(sources));
  if (!agent.ok()) return Fail(CodeOf(agent.status()), agent.status());
  LogInfo("agent " + config.agent + " takes readings at " + (*agent)->address() + ", spool " +
          config.spool + ", server " + config.server);
  if (!line.ready_file.empty() && !WriteReadyFile(line.ready_file, (*agent)->address()))
    LogError(line.ready_file + " can't be written");
  NotifySystemd("READY=1");
  WaitForStop(signals, **agent);
  NotifySystemd("STOPPING=1");
  (*agent)->StopTaking();
  LogInfo("stopped; what was not delivered is sent after the next start");
  if (!line.ready_file.empty()) std::remove(line.ready_file.c_str());
  // A call to a server that is away would hold up the end for half a minute, and nothing depends on
  // its answer.
  std::cerr.flush();
  _exit(client::kExitOk);
}

int Start(const CommandLine& line) {
  const auto config = ReadConfigFile(line.config);
  if (!config.ok()) return Fail(client::kExitInput, config.status());
  SetLogLevel(config->log_level);
  auto sources = MakeSources(config->sources);
  if (!sources.ok()) return Fail(client::kExitInput, sources.status());
  if (!line.check_config) return Serve(line, *config, *std::move(sources));
  std::cout << line.config << ": no faults\n";
  return client::kExitOk;
}

}  // namespace
}  // namespace truepose::agent

int main(int argc, char** argv) {
  truepose::agent::CommandLine line;
  if (const auto code = truepose::agent::ParseCommandLine(argc, argv, &line); code.has_value())
    return *code;
  return truepose::agent::Start(line);
}
