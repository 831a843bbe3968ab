#include "tests/cli/child.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

#include "tests/cli/run.h"

namespace truepose::cli {
namespace {

void Redirect(int descriptor, const std::string& path) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(file, descriptor);
}

}  // namespace

Child::Child(const std::string& folder, const std::string& name,
             const std::vector<std::string>& argv)
    : stem_(folder + "/" + name) {
  std::vector<std::string> copy = argv;
  std::vector<char*> pointers;
  for (std::string& argument : copy) pointers.push_back(argument.data());
  pointers.push_back(nullptr);
  pid_ = fork();
  if (pid_ != 0) return;
  Redirect(STDOUT_FILENO, stem_ + ".out");
  Redirect(STDERR_FILENO, stem_ + ".err");
  execv(pointers[0], pointers.data());
  _exit(127);
}

Child::~Child() {
  if (pid_ < 0) return;
  kill(pid_, SIGKILL);
  Wait();
}

void Child::Signal(int signal) const { kill(pid_, signal); }

int Child::Wait() {
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::string Child::Out() const { return TextOf(stem_ + ".out"); }
std::string Child::Err() const { return TextOf(stem_ + ".err"); }

}  // namespace truepose::cli
