#include "client/cli/secret_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"

namespace truepose::cli {

absl::StatusOr<SecretFile> SecretFile::Create(const std::string& path, const std::string& option) {
  const int descriptor = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor >= 0) return SecretFile(path, descriptor);
  return FaultStatus(option, absl::StrCat("'", path, "': ", std::strerror(errno)),
                     "the name of a file that can be made and is not there yet");
}

SecretFile::SecretFile(SecretFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

SecretFile::~SecretFile() {
  if (descriptor_ < 0) return;
  close(descriptor_);
  unlink(path_.c_str());
}

absl::Status SecretFile::Commit(absl::string_view secret) {
  const std::string line = absl::StrCat(secret, "\n");
  const ssize_t written = write(descriptor_, line.data(), line.size());
  if (written != static_cast<ssize_t>(line.size()) || fsync(descriptor_) != 0)
    return absl::InternalError(absl::StrCat("'", path_,
                                            "' can't be written: the token's secret is "
                                            "lost; revoke it and make another"));
  close(std::exchange(descriptor_, -1));
  return absl::OkStatus();
}

}  // namespace truepose::cli
