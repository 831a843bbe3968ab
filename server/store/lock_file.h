// One process a database: an exclusive lock on `<path>` that the system gives back when the process
// ends.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "absl/status/statusor.h"

namespace truepose::store {

class LockFile {
 public:
  // Creates the file, locks it and writes the process id into it.
  // @returns kFailedPrecondition with a fault (field = `database`) that names the process that
  // holds it.
  static absl::StatusOr<std::unique_ptr<LockFile>> Acquire(const std::string& path,
                                                           const std::string& database);
  // Removes the file, then gives the lock back.
  ~LockFile();

 private:
  LockFile(std::string path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}

  std::string path_;
  int descriptor_;
};

}  // namespace truepose::store
