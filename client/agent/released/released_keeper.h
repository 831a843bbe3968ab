// Keeps one robot's released set up to date, in a thread of its own.
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "client/agent/released/released_store.h"
#include "client/agent/released/server_view.h"
#include "client/agent/stop.h"
#include "client/client.h"

namespace truepose::agent {

struct ReleasedKeeperOptions {
  std::string robot;                       // robots/{robot}
  std::string folder;                      // of its ReleasedCache
  std::chrono::milliseconds pause{1'000};  // between watches; doubled for each failed offer
  std::chrono::milliseconds longest_pause{30'000};
};

class ReleasedKeeper {
 public:
  // Reads the cache, then watches, whether a server is there or not.
  // @param log gets what a person should know, a line each that names the robot, from the thread.
  // @param warn the same of what is wrong; null: `log` gets that as well.
  ReleasedKeeper(const client::Client& client, Disk& disk, ReleasedKeeperOptions options,
                 std::function<void(const std::string&)> log,
                 std::function<void(const std::string&)> warn = nullptr);
  // Waits for the call that is under way.
  ~ReleasedKeeper();
  ReleasedKeeper(const ReleasedKeeper&) = delete;
  ReleasedKeeper& operator=(const ReleasedKeeper&) = delete;

  void RequestStop() { stop_.Request(); }
  const std::string& robot() const { return options_.robot; }
  // What is to be run, from any thread; never null.
  std::shared_ptr<const ReleasedState> state() const { return store_.state(); }
  // What a read-back of the controller has said (AgentReport.controller_state).
  void SetControllerState(const std::string& state) { store_.SetControllerState(state); }

 private:
  void RunThread();
  // @returns whether this watch is to go on.
  bool Take(const v1::WatchResponse& response);
  bool Offer(const ReleasedEntry& released);

  const client::Client& client_;
  const ReleasedKeeperOptions options_;
  ReleasedStore store_;
  ServerView view_;  // of the thread
  int failed_ = 0;   // of the thread: offers in a row that another try may mend
  Stop stop_;
  std::thread thread_;
};

}  // namespace truepose::agent
