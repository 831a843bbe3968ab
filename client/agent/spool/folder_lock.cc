#include "client/agent/spool/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "client/agent/spool/disk.h"
#include "core/base/fault.h"

namespace truepose::agent {
namespace {

std::string Holder(int descriptor) {
  char text[32];
  const ssize_t size = pread(descriptor, text, sizeof(text), 0);
  const absl::string_view pid =
      absl::StripAsciiWhitespace(absl::string_view(text, size > 0 ? size : 0));
  return pid.empty() ? "another process" : absl::StrCat("process ", pid);
}

absl::Status InUse(const std::string& folder, int descriptor) {
  FaultList faults;
  faults.Add(folder, absl::StrCat("a spool in use by ", Holder(descriptor)), "one agent a spool");
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

}  // namespace

// The file stays when the lock is given back: who removes it could remove another one's.
absl::StatusOr<std::unique_ptr<FolderLock>> FolderLock::Acquire(const std::string& folder) {
  const std::string path = folder + "/lock";
  const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (descriptor < 0) return DiskError(path);
  std::unique_ptr<FolderLock> lock(new FolderLock(descriptor));
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) return InUse(folder, descriptor);
  // Only for the message above, so a disk without space doesn't matter.
  const std::string pid = absl::StrCat(getpid(), "\n");
  if (ftruncate(descriptor, 0) != 0 || pwrite(descriptor, pid.data(), pid.size(), 0) < 0) {
    return lock;
  }
  return lock;
}

FolderLock::~FolderLock() { close(descriptor_); }

}  // namespace truepose::agent
