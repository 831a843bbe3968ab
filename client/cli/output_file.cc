#include "client/cli/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"

namespace truepose::cli {
namespace {

bool IsSpecialFile(const std::string& path) {
  struct stat status;
  return stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

bool IsDirectory(const std::string& path) {
  struct stat status;
  return stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode);
}

bool WriteAll(int descriptor, absl::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    text.remove_prefix(static_cast<size_t>(written));
  }
  return true;
}

}  // namespace

absl::StatusOr<OutputFile> OutputFile::Create(std::string path, std::string option) {
  if (IsDirectory(path))
    return FaultStatus(option, absl::StrCat(path, ", a folder"), "a file name");
  const bool special = IsSpecialFile(path);
  const std::string temporary = special ? "" : absl::StrCat(path, ".partial.", getpid());
  const int flags = special ? O_WRONLY : O_WRONLY | O_CREAT | O_EXCL;
  const int descriptor = open(special ? path.c_str() : temporary.c_str(), flags | O_CLOEXEC, 0666);
  OutputFile file(std::move(path), std::move(option), temporary, descriptor);
  if (descriptor < 0) return file.FaultOf(std::strerror(errno));
  return file;
}

OutputFile::OutputFile(std::string path, std::string option, std::string temporary, int descriptor)
    : path_(std::move(path)),
      option_(std::move(option)),
      temporary_(std::move(temporary)),
      descriptor_(descriptor) {}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      option_(std::move(other.option_)),
      temporary_(std::move(other.temporary_)),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

OutputFile::~OutputFile() {
  if (descriptor_ < 0) return;
  close(descriptor_);
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

absl::Status OutputFile::FaultOf(absl::string_view what) const {
  return FaultStatus(option_, absl::StrCat(path_, " (", what, ")"), "a file that can be written");
}

absl::Status OutputFile::Commit(absl::string_view text) {
  // The destructor cleans up after each early return. Pipes can't be synchronised, which is no
  // failure.
  if (!WriteAll(descriptor_, text)) return FaultOf(std::strerror(errno));
  if (temporary_.empty()) return absl::OkStatus();
  if (fsync(descriptor_) != 0) return FaultOf(std::strerror(errno));
  if (rename(temporary_.c_str(), path_.c_str()) != 0) return FaultOf(std::strerror(errno));
  close(std::exchange(descriptor_, -1));
  return absl::OkStatus();
}

}  // namespace truepose::cli
