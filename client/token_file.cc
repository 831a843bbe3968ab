#include "client/token_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "core/base/fault.h"

namespace truepose::client {
namespace {

constexpr size_t kLongest = 512;
constexpr char kExpected[] = "one line with the secret of a token";

class File {
 public:
  explicit File(const std::string& path) : fd_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  ~File() {
    if (fd_ >= 0) close(fd_);
  }
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  int fd() const { return fd_; }

 private:
  const int fd_;
};

// Of the file that was opened, not of one that took its place.
absl::Status CheckMode(const std::string& path, const File& file) {
  struct stat status {};
  if (file.fd() < 0 || fstat(file.fd(), &status) != 0)
    return FaultStatus(path, std::strerror(errno), "a file with the secret of a token");
  if (!S_ISREG(status.st_mode)) return FaultStatus(path, "no file", kExpected);
  if ((status.st_mode & 077) == 0) return absl::OkStatus();
  return FaultStatus(path,
                     absl::StrCat("mode 0", (status.st_mode >> 6) & 7, (status.st_mode >> 3) & 7,
                                  status.st_mode & 7),
                     "0600, since who reads a token is its owner: `chmod 600`");
}

std::string FileAtHome() {
  const char* home = std::getenv("HOME");
  if (home == nullptr || *home == '\0') return "";
  const std::string path = absl::StrCat(home, "/", kTokenFile);
  return access(path.c_str(), F_OK) == 0 ? path : "";
}

}  // namespace

bool IsSecret(const std::string& text) {
  if (text.empty() || text.size() > kLongest) return false;
  for (const char c : text) {
    if (!absl::ascii_isgraph(c)) return false;
  }
  return true;
}

absl::StatusOr<std::string> ReadTokenFile(const std::string& path) {
  const File file(path);
  if (const absl::Status mode = CheckMode(path, file); !mode.ok()) return mode;
  char bytes[kLongest + 2];
  const ssize_t size = read(file.fd(), bytes, sizeof(bytes));
  if (size < 0) return FaultStatus(path, std::strerror(errno), kExpected);
  const std::string secret(absl::StripAsciiWhitespace(absl::string_view(bytes, size)));
  if (!IsSecret(secret)) return FaultStatus(path, "something else", kExpected);
  return secret;
}

absl::StatusOr<std::string> FindToken(const std::string& named) {
  if (!named.empty()) return ReadTokenFile(named);
  const char* variable = std::getenv(kTokenVariable);
  if (variable != nullptr && *variable != '\0') {
    if (IsSecret(variable)) return std::string(variable);
    return FaultStatus(kTokenVariable, "something else", "the secret of a token");
  }
  const std::string at_home = FileAtHome();
  return at_home.empty() ? std::string() : ReadTokenFile(at_home);
}

}  // namespace truepose::client
