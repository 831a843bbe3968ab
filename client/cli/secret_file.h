// A file for a secret that is told once.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

namespace truepose::cli {

// Made empty, with mode 0600, before the secret is asked for, so that a place that can't be written
// to costs no secret. A file that is there stays as it is: it may hold a token that is in use.
class SecretFile {
 public:
  // @param option the option that named the file, for the fault.
  // @returns kInvalidArgument with a fault when no new file can be made there.
  static absl::StatusOr<SecretFile> Create(const std::string& path, const std::string& option);

  SecretFile(SecretFile&& other) noexcept;
  SecretFile& operator=(SecretFile&&) = delete;
  // Removes the file when nothing was written.
  ~SecretFile();

  // `secret` and a line end, synced. Once only.
  absl::Status Commit(absl::string_view secret);

 private:
  SecretFile(std::string path, int descriptor) : path_(std::move(path)), descriptor_(descriptor) {}

  std::string path_;
  int descriptor_ = -1;  // -1: done or moved from
};

}  // namespace truepose::cli
