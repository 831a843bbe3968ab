// trueposed as a child process, ended by its id at the latest with this object.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "absl/time/time.h"
#include "tests/server/testing/temp_dir.h"

namespace truepose::testing {

class ServerProcess {
 public:
  // kOpenToAll: with --dev-open.
  enum class Access { kOpenToAll, kTokens };

  // Starts trueposed with `arguments`, --listen and --ready-file in `folder`, without waiting.
  ServerProcess(const TempDir& folder, const std::vector<std::string>& arguments,
                Access access = Access::kOpenToAll);
  // Kill().
  ~ServerProcess();
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  // Waits until calls are served. false: the process ended or half a minute passed.
  bool WaitUntilReady();
  // From its start until WaitUntilReady saw it ready.
  absl::Duration ready_after() const { return ready_after_; }
  // Memory of the process that is in use now (its resident set), bytes.
  int64_t ResidentBytes() const;
  const std::string& address() const { return address_; }

  // kill -9, and waits until it is gone.
  void Kill();
  void Signal(int number) const;
  // Waits for the end by itself. @returns the exit code, 128 + n for signal n.
  int Wait();
  // What it wrote to stdout and stderr.
  std::string Output() const;

 private:
  bool HasEnded();

  const std::string ready_file_, output_file_, address_;
  const absl::Time started_;
  absl::Duration ready_after_;
  pid_t pid_ = 0;
  int status_ = 0;
  bool ended_ = false;
};

}  // namespace truepose::testing
