#include "tests/integration/server_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include "absl/time/clock.h"

namespace truepose::testing {
namespace {

// In the child: only calls that are safe after a fork of a process with threads.
[[noreturn]] void Execute(const std::vector<char*>& arguments, const char* output_file) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // a test that dies leaves no server behind
  const int output = open(output_file, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  execv(arguments[0], arguments.data());
  _exit(127);
}

}  // namespace

ServerProcess::ServerProcess(const TempDir& folder, const std::vector<std::string>& arguments,
                             Access access)
    : ready_file_(folder.File("ready")),
      output_file_(folder.File("output")),
      address_("unix:" + folder.File("s.sock")),
      started_(absl::Now()) {
  std::filesystem::remove(ready_file_);
  // The test's own arguments come last, so that they win.
  std::vector<std::string> words = {TRUEPOSED, "--listen", address_, "--ready-file", ready_file_};
  if (access == Access::kOpenToAll) words.push_back("--dev-open");
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  pid_ = fork();
  if (pid_ == 0) Execute(pointers, output_file_.c_str());
}

ServerProcess::~ServerProcess() { Kill(); }

bool ServerProcess::HasEnded() {
  if (!ended_) ended_ = waitpid(pid_, &status_, WNOHANG) == pid_;
  return ended_;
}

bool ServerProcess::WaitUntilReady() {
  while (!HasEnded() && absl::Now() - started_ < absl::Seconds(30)) {
    if (std::filesystem::exists(ready_file_)) {
      ready_after_ = absl::Now() - started_;
      return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return false;
}

int64_t ServerProcess::ResidentBytes() const {
  int64_t size = 0, resident = 0;
  std::ifstream("/proc/" + std::to_string(pid_) + "/statm") >> size >> resident;
  return resident * sysconf(_SC_PAGESIZE);
}

void ServerProcess::Kill() {
  if (HasEnded()) return;
  kill(pid_, SIGKILL);
  Wait();
}

void ServerProcess::Signal(int number) const { kill(pid_, number); }

int ServerProcess::Wait() {
  if (!ended_) ended_ = waitpid(pid_, &status_, 0) == pid_;
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
}

std::string ServerProcess::Output() const {
  std::ostringstream text;
  text << std::ifstream(output_file_).rdbuf();
  return text.str();
}

}  // namespace truepose::testing
