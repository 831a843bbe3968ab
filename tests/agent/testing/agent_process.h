// truepose-agent as a child process, ended by its id at the latest with this object.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>

#include "tests/server/testing/temp_dir.h"

namespace truepose::testing {

class AgentProcess {
 public:
  // Starts it with the configuration `text`, written into `folder`, without waiting.
  AgentProcess(const TempDir& folder, const std::string& text);
  // Kill().
  ~AgentProcess();
  AgentProcess(const AgentProcess&) = delete;
  AgentProcess& operator=(const AgentProcess&) = delete;

  // Waits until readings are taken. false: it ended or half a minute passed.
  bool WaitUntilReady();
  // Of the TCP interface.
  std::string address() const;
  std::chrono::duration<double> ready_after() const { return ready_after_; }
  int64_t ResidentBytes() const;
  // No file of it may grow beyond; 0 = as far as there is space again.
  void LimitFiles(int64_t bytes) const;
  void Signal(int number) const;
  void Kill();
  // Waits for the end by itself. @returns the exit code, 128 + n for signal n.
  int Wait();
  std::string Output() const;

 private:
  bool HasEnded();

  const std::string ready_file_, output_file_;
  const std::chrono::steady_clock::time_point started_;
  std::chrono::duration<double> ready_after_{0};
  pid_t pid_ = 0;
  int status_ = 0;
  bool ended_ = false;
};

}  // namespace truepose::testing
