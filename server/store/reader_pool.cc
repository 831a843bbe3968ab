#include "server/store/reader_pool.h"

#include <utility>

#include "core/base/status_macros.h"
#include "server/store/sql/sqlite.h"

namespace truepose::store {

absl::Status ReaderPool::WithConnection(const std::function<absl::Status(sql::Connection&)>& use) {
  TRUEPOSE_ASSIGN_OR_RETURN(std::unique_ptr<sql::Connection> connection, Take());
  const absl::Status status = use(*connection);
  GiveBack(std::move(connection));
  return status;
}

absl::StatusOr<std::unique_ptr<sql::Connection>> ReaderPool::Take() {
  std::unique_lock lock(mutex_);
  returned_.wait(lock, [this] { return unopened_ > 0 || !idle_.empty(); });
  if (!idle_.empty()) {
    std::unique_ptr<sql::Connection> connection = std::move(idle_.back());
    idle_.pop_back();
    return connection;
  }
  --unopened_;
  lock.unlock();
  auto connection = sql::OpenSqlite(path_, sql::Access::kRead);
  if (!connection.ok()) GiveBack(nullptr);
  return connection;
}

void ReaderPool::GiveBack(std::unique_ptr<sql::Connection> connection) {
  {
    const std::lock_guard lock(mutex_);
    if (connection == nullptr) {
      ++unopened_;
    } else {
      idle_.push_back(std::move(connection));
    }
  }
  returned_.notify_one();
}

}  // namespace truepose::store
