// The files of a database, looked at before SQLite touches them, so that a refusal leaves
// everything as it was.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace truepose::store {

// The same file under one name, with links resolved, so that every name of it meets the same lock.
// @returns kNotFound with a fault when the directory doesn't exist.
absl::StatusOr<std::string> ResolveDatabasePath(const std::string& path);

// @returns kFailedPrecondition with a fault when `path` is no regular file, isn't a database, or
// can't be written.
//   A file that doesn't exist or is empty is fine.
absl::Status CheckDatabaseFile(const std::string& path);

// Makes an empty file of a database that didn't exist, and removes it again unless it is kept. What
// can't be made is left to who opens it.
class NewDatabase {
 public:
  explicit NewDatabase(std::string path);
  NewDatabase(const NewDatabase&) = delete;
  NewDatabase& operator=(const NewDatabase&) = delete;
  ~NewDatabase();

  void Keep() { remove_ = false; }

 private:
  std::string path_;
  bool remove_;
};

}  // namespace truepose::store
