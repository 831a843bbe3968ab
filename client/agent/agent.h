// The whole agent: spool, delivery, requests, TCP interface and sources.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "absl/status/statusor.h"
#include "client/agent/config/config.h"
#include "client/agent/delivery/delivery.h"
#include "client/agent/intake/intake.h"
#include "client/agent/lines/agent_status.h"
#include "client/agent/lines/conversation.h"
#include "client/agent/lines/line_server.h"
#include "client/agent/released/released_keeper.h"
#include "client/agent/released/released_lines.h"
#include "client/agent/requests/request_keeper.h"
#include "client/agent/requests/robot_watch.h"
#include "client/agent/source.h"

namespace truepose::agent {

class Agent {
 public:
  // Takes the spool, listens, and starts everything; the server need not be there.
  // @returns kInvalidArgument with faults of the configuration; kFailedPrecondition when another
  //   agent has the spool; kUnavailable when the folder or the address can't be used.
  static absl::StatusOr<std::unique_ptr<Agent>> Start(const AgentConfig& config,
                                                      std::vector<std::unique_ptr<Source>> sources);
  // Stops taking readings, then waits for the calls that are under way.
  ~Agent();
  Agent(const Agent&) = delete;
  Agent& operator=(const Agent&) = delete;

  // No readings are taken any more. All that were are on the disk, so that the process may end in
  // whatever way from here on.
  void StopTaking();
  AgentStatus Status() const;
  // Of the TCP interface, with its port; "" = none.
  std::string address() const;

 private:
  Agent(const AgentConfig& config, client::Client client);
  absl::Status Open();
  absl::Status Listen();
  void StartThreads(std::vector<std::unique_ptr<Source>> sources);
  std::unique_ptr<RobotWatch> Watch(const std::string& robot);
  void KeepReleasedSets();
  ReleasedDesk DeskOfReleasedSets() const;
  ReleasedKeeper* KeeperOf(const std::string& robot) const;  // null for another's
  void OnRequest(const std::string& robot, const v1::RecalibrationRequest& request,
                 bool is_snapshot);
  void OnSnapshot(const std::string& robot, bool has_open_request);
  void OnRobot(const v1::Robot& robot);
  void OnLost(const std::string& robot, const absl::Status& why);
  void Wake();
  // What the server should know of this agent; at most every minute unless something changed.
  void Report();
  v1::AgentReport ReportOf(const RobotStatus& robot, const AgentStatus& status) const;

  const AgentConfig config_;
  const client::Client client_;
  Disk disk_;
  std::unique_ptr<Spool> spool_;
  std::unique_ptr<RequestBook> book_;
  std::unique_ptr<Intake> intake_;
  std::unique_ptr<Desk> desk_;
  std::atomic<int64_t> taken_{0}, refused_{0};

  mutable std::mutex mutex_;
  std::map<std::string, RobotStatus> robots_;
  std::string last_report_;  // of the thread that reports
  std::chrono::steady_clock::time_point next_report_{};

  // In the order in which they are started; ended in the reverse one.
  std::vector<std::unique_ptr<ReleasedKeeper>> released_;
  std::unique_ptr<Delivery> delivery_;
  std::unique_ptr<RequestKeeper> keeper_;
  std::vector<std::unique_ptr<RobotWatch>> watches_;
  std::unique_ptr<LineServer> lines_;
  Stop stop_sources_;
  std::vector<std::unique_ptr<Source>> sources_;
  std::vector<std::thread> source_threads_;
};

}  // namespace truepose::agent
