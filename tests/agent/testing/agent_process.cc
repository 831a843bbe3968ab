#include "tests/agent/testing/agent_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>
#include <vector>

namespace truepose::testing {
namespace {

std::string ReadAll(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace

AgentProcess::AgentProcess(const TempDir& folder, const std::string& text)
    : ready_file_(folder.File("agent.ready")),
      output_file_(folder.File("agent.output")),
      started_(std::chrono::steady_clock::now()) {
  const std::string config = folder.File("agent.toml");
  std::ofstream(config) << text;
  std::filesystem::remove(ready_file_);
  std::vector<std::string> words = {TRUEPOSE_AGENT, "--config", config, "--ready-file",
                                    ready_file_};
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  pid_ = fork();
  if (pid_ != 0) return;
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // a test that dies leaves no agent behind
  const int output = open(output_file_.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  execv(pointers[0], pointers.data());
  _exit(127);
}

AgentProcess::~AgentProcess() { Kill(); }

bool AgentProcess::HasEnded() {
  if (!ended_) ended_ = waitpid(pid_, &status_, WNOHANG) == pid_;
  return ended_;
}

bool AgentProcess::WaitUntilReady() {
  while (!HasEnded()) {
    ready_after_ = std::chrono::steady_clock::now() - started_;
    if (std::filesystem::exists(ready_file_)) return true;
    if (ready_after_ > std::chrono::seconds(30)) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return false;
}

std::string AgentProcess::address() const {
  std::string address = ReadAll(ready_file_);
  if (!address.empty()) address.pop_back();
  return address;
}

int64_t AgentProcess::ResidentBytes() const {
  int64_t size = 0, resident = 0;
  std::ifstream("/proc/" + std::to_string(pid_) + "/statm") >> size >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

void AgentProcess::LimitFiles(int64_t bytes) const {
  const rlimit limit{bytes == 0 ? RLIM_INFINITY : static_cast<rlim_t>(bytes), RLIM_INFINITY};
  prlimit(pid_, RLIMIT_FSIZE, &limit, nullptr);
}

void AgentProcess::Signal(int number) const { kill(pid_, number); }

void AgentProcess::Kill() {
  if (HasEnded()) return;
  kill(pid_, SIGKILL);
  Wait();
}

int AgentProcess::Wait() {
  if (!ended_) ended_ = waitpid(pid_, &status_, 0) == pid_;
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
}

std::string AgentProcess::Output() const { return ReadAll(output_file_); }

}  // namespace truepose::testing
