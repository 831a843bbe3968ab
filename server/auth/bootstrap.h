// The one-time secret from which the first admin comes: whoever can read a file beside the database
// owns the server anyway.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace truepose::auth {

// All functions are safe from any thread.
class Bootstrap {
 public:
  // `wanted`: writes a new secret into the file `path`, mode 0600, in place of any that an earlier
  // server left there. Else removes such a one, and no secret is right.
  // @returns kFailedPrecondition with a fault of `path` when the file can't be written.
  static absl::StatusOr<std::unique_ptr<Bootstrap>> Begin(const std::string& path, bool wanted);

  // Removes a file that was not used: without this server its secret is worth nothing.
  ~Bootstrap();

  // Runs `grant` when `secret` is right. When that returns OK, the secret is used up and the file
  // removed; else it may be tried again.
  // @returns grant's status; kFailedPrecondition when no bootstrap is due; kPermissionDenied for
  // another secret.
  absl::Status Use(std::string_view secret, const std::function<absl::Status()>& grant);

  // The file that waits to be used; "" = none.
  std::string waiting_file() const;

 private:
  explicit Bootstrap(const std::string& path) : path_(path) {}

  const std::string path_;
  mutable std::mutex mutex_;
  std::string hash_;  // of the secret; "" = none is due
};

}  // namespace truepose::auth
