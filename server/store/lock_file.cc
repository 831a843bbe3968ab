#include "server/store/lock_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::store {
namespace {

absl::Status Refuse(const std::string& database, std::string found, std::string expected) {
  FaultList faults;
  faults.Add(database, std::move(found), std::move(expected));
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

std::string Holder(int descriptor) {
  char text[32];
  const ssize_t size = pread(descriptor, text, sizeof(text), 0);
  const absl::string_view pid =
      absl::StripAsciiWhitespace(absl::string_view(text, size > 0 ? size : 0));
  return pid.empty() ? "another process" : absl::StrCat("process ", pid);
}

// An open descriptor with the lock, -1 when the file was removed meanwhile by the one who held it
// before.
absl::StatusOr<int> TryLock(const std::string& path, const std::string& database) {
  const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0) {
    return Refuse(database, absl::StrCat("lock file ", path, ": ", std::strerror(errno)),
                  "one that can be written");
  }
  if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
    const std::string holder = Holder(descriptor);
    close(descriptor);
    return Refuse(database, absl::StrCat("a database in use by ", holder),
                  "one server per database");
  }
  struct stat locked, named;
  const bool same = fstat(descriptor, &locked) == 0 && stat(path.c_str(), &named) == 0 &&
                    locked.st_ino == named.st_ino && locked.st_dev == named.st_dev;
  if (same) return descriptor;
  close(descriptor);
  return -1;
}

absl::Status WritePid(int descriptor, const std::string& path) {
  const std::string pid = absl::StrCat(getpid(), "\n");
  if (ftruncate(descriptor, 0) == 0 &&
      pwrite(descriptor, pid.data(), pid.size(), 0) == ssize_t(pid.size())) {
    return absl::OkStatus();
  }
  return absl::UnavailableError(absl::StrCat("lock file ", path, ": ", std::strerror(errno)));
}

}  // namespace

absl::StatusOr<std::unique_ptr<LockFile>> LockFile::Acquire(const std::string& path,
                                                            const std::string& database) {
  int descriptor = -1;
  while (descriptor < 0) {
    TRUEPOSE_ASSIGN_OR_RETURN(descriptor, TryLock(path, database));
  }
  std::unique_ptr<LockFile> lock(new LockFile(path, descriptor));
  TRUEPOSE_RETURN_IF_ERROR(WritePid(descriptor, path));
  return lock;
}

LockFile::~LockFile() {
  unlink(path_.c_str());
  close(descriptor_);
}

}  // namespace truepose::store
