#include "server/store/database_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"

namespace truepose::store {
namespace {

namespace fs = std::filesystem;

// The first 16 bytes of every SQLite database, with the closing zero.
constexpr char kMagic[] = "SQLite format 3";
constexpr mode_t kWriteBits = S_IWUSR | S_IWGRP | S_IWOTH;

absl::Status Refuse(const std::string& path, std::string found, std::string expected,
                    absl::StatusCode code = absl::StatusCode::kFailedPrecondition) {
  FaultList faults;
  faults.Add(path, std::move(found), std::move(expected));
  return faults.ToStatus(code);
}

std::string ParentOf(const std::string& path) {
  const fs::path parent = fs::path(path).parent_path();
  return parent.empty() ? "." : parent.string();
}

bool HasMagic(const std::string& path) {
  char head[sizeof(kMagic)] = {};
  std::ifstream file(path, std::ios::binary);
  file.read(head, sizeof(head));
  return std::string_view(head, file.gcount()) == std::string_view(kMagic, sizeof(kMagic));
}

// The superuser may write everything; a file that nobody may write is still meant to stay as it is.
bool IsWritable(const std::string& path, mode_t mode) {
  return (mode & kWriteBits) != 0 && access(path.c_str(), W_OK) == 0;
}

}  // namespace

absl::StatusOr<std::string> ResolveDatabasePath(const std::string& path) {
  std::error_code error;
  const std::string parent = ParentOf(path);
  if (!fs::is_directory(parent, error)) {
    return Refuse(path, absl::StrCat("no directory ", parent), "an existing directory",
                  absl::StatusCode::kNotFound);
  }
  const fs::path resolved = fs::weakly_canonical(path, error);
  if (error) return Refuse(path, error.message(), "a file name");
  return resolved.string();
}

absl::Status CheckDatabaseFile(const std::string& path) {
  const std::string parent = ParentOf(path);
  struct stat status;
  if (stat(path.c_str(), &status) == 0) {
    if (!S_ISREG(status.st_mode)) return Refuse(path, "a directory or device", "a database file");
    if (access(path.c_str(), R_OK) != 0)
      return Refuse(path, "a file that can't be read", "a Truepose database");
    if (status.st_size > 0 && !HasMagic(path)) {
      return Refuse(path, "a file that is not a database", "a Truepose database or a new file");
    }
    if (!IsWritable(path, status.st_mode))
      return Refuse(path, "a read-only file", "a file that can be written");
  }
  if (access(parent.c_str(), W_OK) != 0) {
    return Refuse(path, absl::StrCat("a read-only directory ", parent),
                  "a directory that can be written");
  }
  return absl::OkStatus();
}

// Of its owner alone, as it holds hashes of tokens; SQLite gives its other files the same mode.
NewDatabase::NewDatabase(std::string path) : path_(std::move(path)), remove_(!fs::exists(path_)) {
  if (!remove_) return;
  const int file = open(path_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, S_IRUSR | S_IWUSR);
  if (file >= 0) close(file);
}

NewDatabase::~NewDatabase() {
  if (!remove_) return;
  for (const char* suffix : {"", "-wal", "-shm", "-journal"}) unlink((path_ + suffix).c_str());
}

}  // namespace truepose::store
