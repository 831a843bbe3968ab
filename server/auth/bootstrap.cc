#include "server/auth/bootstrap.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "server/auth/secret.h"
#include "server/store/message.h"

namespace truepose::auth {
namespace {

// A new file, so that neither a link nor the mode of one that was there before gets the secret.
absl::Status WriteNew(const std::string& path, const std::string& text) {
  unlink(path.c_str());
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  const bool written = file >= 0 &&
                       write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                       fsync(file) == 0;
  const std::string reason = std::strerror(errno);
  if (file >= 0) close(file);
  if (written) return absl::OkStatus();
  if (file >= 0) unlink(path.c_str());
  return store::Refusal(absl::StatusCode::kFailedPrecondition, path, reason,
                        "a file that can be written, for the first admin's secret");
}

}  // namespace

absl::StatusOr<std::unique_ptr<Bootstrap>> Bootstrap::Begin(const std::string& path, bool wanted) {
  std::unique_ptr<Bootstrap> bootstrap(new Bootstrap(path));
  if (!wanted) {
    unlink(path.c_str());
    return bootstrap;
  }
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string secret, NewSecret());
  TRUEPOSE_RETURN_IF_ERROR(WriteNew(path, secret + "\n"));
  bootstrap->hash_ = HashOf(secret);
  return bootstrap;
}

Bootstrap::~Bootstrap() {
  if (!hash_.empty()) unlink(path_.c_str());
}

absl::Status Bootstrap::Use(std::string_view secret, const std::function<absl::Status()>& grant) {
  const std::lock_guard lock(mutex_);
  if (hash_.empty()) {
    return store::Refusal(absl::StatusCode::kFailedPrecondition, "secret",
                          "a server that has an admin",
                          "`truepose token create` with an admin's token; when all are lost, a "
                          "start with --bootstrap");
  }
  const absl::string_view shown =
      absl::StripAsciiWhitespace(absl::string_view(secret.data(), secret.size()));
  if (HashOf({shown.data(), shown.size()}) != hash_) {
    return store::Refusal(absl::StatusCode::kPermissionDenied, "secret", "another secret",
                          "the content of the file that this start of the server wrote beside its "
                          "database, <database>.bootstrap");
  }
  TRUEPOSE_RETURN_IF_ERROR(grant());
  hash_.clear();
  unlink(path_.c_str());
  return absl::OkStatus();
}

std::string Bootstrap::waiting_file() const {
  const std::lock_guard lock(mutex_);
  return hash_.empty() ? "" : path_;
}

}  // namespace truepose::auth
