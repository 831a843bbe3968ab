// Connections for reading beside the writer, opened when they are first needed.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/store/sql/connection.h"

namespace truepose::store {

class ReaderPool {
 public:
  ReaderPool(std::string path, int size) : path_(std::move(path)), unopened_(size) {}

  // Lends a connection to the calling thread; waits while all are in use.
  absl::Status WithConnection(const std::function<absl::Status(sql::Connection&)>& use);

 private:
  absl::StatusOr<std::unique_ptr<sql::Connection>> Take();
  // nullptr gives back the right to open one.
  void GiveBack(std::unique_ptr<sql::Connection> connection);

  const std::string path_;
  std::mutex mutex_;
  std::condition_variable returned_;
  std::vector<std::unique_ptr<sql::Connection>> idle_;
  int unopened_;
};

}  // namespace truepose::store
