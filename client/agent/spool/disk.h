// What a spool asks of the disk and what fails when there is no space; tests put faults in between.
#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace truepose::agent {

// As the system's calls of these names: -1 and errno, or less than was asked for.
class Disk {
 public:
  virtual ~Disk() = default;
  virtual ssize_t Read(int descriptor, char* bytes, size_t size, off_t offset);
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

// Exactly `size` bytes from `offset` on. @returns DiskError also when the file ends before.
absl::StatusOr<std::string> ReadWhole(Disk& disk, int descriptor, off_t offset, size_t size,
                                      const std::string& path);

// Names that were made, renamed or removed in the folder survive a power failure.
absl::Status SyncFolder(Disk& disk, const std::string& folder);

// Of `path`, `path`.2, `path`.3... the first that is not there.
std::string FreshPath(const std::string& path);

// `bytes` as a new file, durable with its name; a failure leaves nothing behind.
absl::Status WriteNewFile(Disk& disk, const std::string& path, std::string_view bytes);

// The whole file, written beside and renamed: whoever reads `path` sees the old bytes or the new.
absl::Status ReplaceFile(Disk& disk, const std::string& path, std::string_view bytes);

}  // namespace truepose::agent
