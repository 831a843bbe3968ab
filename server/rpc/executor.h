// A few threads and a bounded queue: where handlers run, because a reaction of gRPC must not wait
// for a commit.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace truepose::rpc {

class Executor {
 public:
  // @param threads at least 1. @param most_waiting tasks that may wait for a thread.
  Executor(int threads, size_t most_waiting);
  // Runs what was accepted, then ends the threads.
  ~Executor();

  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  // false when too many tasks wait or the executor is stopping; the task is then not run.
  [[nodiscard]] bool Submit(std::function<void()> task);

 private:
  void Work();

  const size_t most_waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> waiting_;
  bool stopping_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace truepose::rpc
