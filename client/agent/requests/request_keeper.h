// Makes the steps of the open requests, and says to the server what this agent does.
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "client/agent/requests/next_step.h"
#include "client/agent/requests/request_book.h"
#include "client/agent/spool/spool.h"
#include "client/client.h"

namespace truepose::agent {

struct RequestKeeperOptions {
  std::vector<std::string> robots;
  NextStepOptions steps;
  std::chrono::milliseconds interval{1'000};  // of looks at what nobody told of
  std::function<void()> after_pass = [] {};   // in the thread, once all robots were looked after
};

class RequestKeeper {
 public:
  // @param log gets what a person should know, a line each, from the thread.
  RequestKeeper(RequestKeeperOptions options, RequestBook& book, Spool& spool,
                const client::Client& client, std::function<void(const std::string&)> log);
  // Ends the thread; waits for the call that is under way.
  ~RequestKeeper();
  RequestKeeper(const RequestKeeper&) = delete;
  RequestKeeper& operator=(const RequestKeeper&) = delete;

  // Something has changed: a request, a session, or a person's answer.
  void Notify();
  void RequestStop();

 private:
  void RunThread();
  bool Wait();
  void Pause();
  // Makes steps of a robot until none is left. @returns the step that failed.
  absl::Status Keep(const std::string& robot);
  absl::Status Make(StepKind step, const std::string& robot, const OpenRequest& open,
                    const RequestSession& session);
  absl::Status FetchPoses(const std::string& robot, const OpenRequest& open);
  RequestSession SessionOf(const std::string& name) const;
  // A session may have been begun before the book could be told.
  void FindSession(const std::string& robot, OpenRequest& open);

  const RequestKeeperOptions options_;
  RequestBook& book_;
  Spool& spool_;
  const client::Client& client_;
  const std::function<void(const std::string&)> log_;
  std::map<std::string, std::string> problems_;  // of the thread: of each robot, as logged last
  std::mutex mutex_;
  std::condition_variable changed_;
  bool notified_ = true, stopping_ = false;
  std::thread thread_;
};

}  // namespace truepose::agent
