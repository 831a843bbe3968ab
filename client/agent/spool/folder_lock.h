// One agent a spool: a lock that the system gives back when the process ends, however it ends.
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"

namespace truepose::agent {

class FolderLock {
 public:
  // Locks `folder`/lock, made when it is not there, and writes the process id into it.
  // @returns kFailedPrecondition with a fault of the folder that names who holds it; kUnavailable.
  static absl::StatusOr<std::unique_ptr<FolderLock>> Acquire(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  explicit FolderLock(int descriptor) : descriptor_(descriptor) {}

  const int descriptor_;
};

}  // namespace truepose::agent
