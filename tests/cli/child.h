// The real program as a child process.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

namespace truepose::cli {

// Runs with standard output and standard error into files of `folder`, named `name`.out and
// `name`.err.
class Child {
 public:
  Child(const std::string& folder, const std::string& name, const std::vector<std::string>& argv);
  // Ends it if it still runs.
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  void Signal(int signal) const;
  // Waits for its end. @returns its exit code, or 128 + the signal that ended it.
  int Wait();

  std::string Out() const;
  std::string Err() const;

 private:
  std::string stem_;
  pid_t pid_ = -1;
};

}  // namespace truepose::cli
