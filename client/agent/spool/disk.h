// What a spool asks of the disk and what fails when there is no space; tests put faults in between.
#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>

#include "absl/status/status.h"

namespace truepose::agent {

// As the system's calls of these names: -1 and errno, or less than was asked for.
class Disk {
 public:
  virtual ~Disk() = default;
  virtual ssize_t Write(int descriptor, std::string_view bytes, off_t offset);
  virtual int Sync(int descriptor);
  virtual int Truncate(int descriptor, off_t size);
};

// errno as a status that names `path`: kResourceExhausted where space is wanting, else
// kUnavailable.
absl::Status DiskError(const std::string& path);

// All of `bytes` at `offset`, and durable. What a failure leaves behind `offset` is unspecified.
absl::Status WriteDurably(Disk& disk, int descriptor, std::string_view bytes, off_t offset,
                          const std::string& path);

// Names that were made, renamed or removed in the folder survive a power failure.
absl::Status SyncFolder(Disk& disk, const std::string& folder);

// The whole file, written beside and renamed: whoever reads `path` sees the old bytes or the new.
absl::Status ReplaceFile(Disk& disk, const std::string& path, std::string_view bytes);

}  // namespace truepose::agent
