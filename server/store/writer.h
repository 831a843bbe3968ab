// The one thread that writes. Closures that wait while it commits share the next commit.
//
// A second thread tells those that did not wait how it ended, so that what they do with it (such as
// sending an answer) runs beside the next commit.
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

  // Returns at once. `done` is called once with the result, after the commit, in the order of the
  // calls of Submit; it must be brief and must not call Write.
  void Submit(std::function<absl::Status(Transaction&)> closure,
              std::function<void(const absl::Status&)> done);

  // Lends the connection to the calling thread between two groups; for databases that have only
  // one.
  absl::Status WithConnection(const std::function<absl::Status(sql::Connection&)>& use);

 private:
  struct Waiting : Work {
    // Empty when a thread waits in Write().
    std::function<void(const absl::Status&)> done;
    bool is_done = false;
  };
  using Group = std::vector<std::shared_ptr<Waiting>>;

  void Loop();
  Group TakeGroup();
  void Answer(Group group);
  void AnswerLoop();
  Group TakeAnswers();
  // false when the store is closing.
  bool Enqueue(std::shared_ptr<Waiting> waiting);

  const std::unique_ptr<sql::Connection> connection_;
  const Clock& clock_;
  const size_t max_group_;
  std::mutex connection_mutex_;
  std::mutex mutex_;  // of all below
  std::condition_variable arrived_;
  std::condition_variable answered_;
  std::deque<std::shared_ptr<Waiting>> queue_;
  bool stopping_ = false;
  std::mutex answers_mutex_;  // of the two below
  std::condition_variable answers_arrived_;
  Group answers_;
  bool answers_end_ = false;
  std::thread answer_thread_;
  std::thread thread_;
};

}  // namespace truepose::store
