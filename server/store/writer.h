// The one thread that writes. Closures that wait while it commits share the next commit.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "absl/status/status.h"
#include "server/store/clock.h"
#include "server/store/group_commit.h"
#include "server/store/sql/connection.h"
#include "server/store/transaction.h"

namespace truepose::store {

class Writer {
 public:
  Writer(std::unique_ptr<sql::Connection> connection, const Clock& clock, int max_group);
  // Lets the running group end; what still waits is answered with kCancelled.
  ~Writer();

  // Waits for the commit. Not from within a closure.
  absl::Status Write(std::function<absl::Status(Transaction&)> closure);

  // Lends the connection to the calling thread between two groups; for databases that have only
  // one.
  absl::Status WithConnection(const std::function<absl::Status(sql::Connection&)>& use);

 private:
  struct Waiting : Work {
    bool done = false;
  };

  void Loop();
  std::vector<Waiting*> TakeGroup();
  void Answer(const std::vector<Waiting*>& group);
  absl::Status Enqueue(Waiting& waiting);

  const std::unique_ptr<sql::Connection> connection_;
  const Clock& clock_;
  const size_t max_group_;
  std::mutex connection_mutex_;
  std::mutex mutex_;  // of all below
  std::condition_variable arrived_;
  std::condition_variable answered_;
  std::deque<Waiting*> queue_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace truepose::store
