#include "client/agent/spool/disk.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"

namespace truepose::agent {

ssize_t Disk::Write(int descriptor, std::string_view bytes, off_t offset) {
  return pwrite(descriptor, bytes.data(), bytes.size(), offset);
}

int Disk::Sync(int descriptor) { return fdatasync(descriptor); }

int Disk::Truncate(int descriptor, off_t size) { return ftruncate(descriptor, size); }

absl::Status DiskError(const std::string& path) {
  const int error = errno;
  const std::string text = absl::StrCat(path, ": ", std::strerror(error));
  const bool full = error == ENOSPC || error == EDQUOT || error == EFBIG;
  return full ? absl::ResourceExhaustedError(text) : absl::UnavailableError(text);
}

absl::Status WriteDurably(Disk& disk, int descriptor, std::string_view bytes, off_t offset,
                          const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t written = disk.Write(descriptor, bytes, offset);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return DiskError(path);
    bytes.remove_prefix(static_cast<size_t>(written));
    offset += written;
  }
  return disk.Sync(descriptor) == 0 ? absl::OkStatus() : DiskError(path);
}

absl::Status SyncFolder(Disk& disk, const std::string& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return DiskError(folder);
  const absl::Status status = disk.Sync(descriptor) == 0 ? absl::OkStatus() : DiskError(folder);
  close(descriptor);
  return status;
}

absl::Status ReplaceFile(Disk& disk, const std::string& path, std::string_view bytes) {
  const std::string made = path + ".new";
  const int descriptor = open(made.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (descriptor < 0) return DiskError(made);
  const absl::Status written = WriteDurably(disk, descriptor, bytes, 0, made);
  close(descriptor);
  TRUEPOSE_RETURN_IF_ERROR(written);
  if (std::rename(made.c_str(), path.c_str()) != 0) return DiskError(path);
  return SyncFolder(disk, path.substr(0, path.rfind('/')));
}

}  // namespace truepose::agent
