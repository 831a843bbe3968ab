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

ssize_t Disk::Read(int descriptor, char* bytes, size_t size, off_t offset) {
  return pread(descriptor, bytes, size, offset);
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

absl::StatusOr<std::string> ReadWhole(Disk& disk, int descriptor, off_t offset, size_t size,
                                      const std::string& path) {
  std::string bytes(size, '\0');
  for (size_t filled = 0; filled < size;) {
    const ssize_t got = disk.Read(descriptor, bytes.data() + filled, size - filled,
                                  offset + static_cast<off_t>(filled));
    if (got < 0 && errno == EINTR) continue;
    if (got == 0) errno = EIO;
    if (got <= 0) return DiskError(path);
    filled += static_cast<size_t>(got);
  }
  return bytes;
}

absl::Status SyncFolder(Disk& disk, const std::string& folder) {
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return DiskError(folder);
  const absl::Status status = disk.Sync(descriptor) == 0 ? absl::OkStatus() : DiskError(folder);
  close(descriptor);
  return status;
}

std::string FreshPath(const std::string& path) {
  std::string fresh = path;
  for (int number = 2; access(fresh.c_str(), F_OK) == 0; ++number)
    fresh = absl::StrCat(path, ".", number);
  return fresh;
}

absl::Status WriteNewFile(Disk& disk, const std::string& path, std::string_view bytes) {
  const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0) return DiskError(path);
  absl::Status status = WriteDurably(disk, descriptor, bytes, 0, path);
  close(descriptor);
  if (status.ok()) status = SyncFolder(disk, path.substr(0, path.rfind('/')));
  if (!status.ok()) unlink(path.c_str());
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
