// Hears of what changes for one robot, in a thread of its own, however often the server goes away.
#pragma once

#include <functional>
#include <string>
#include <thread>

#include "client/agent/stop.h"
#include "client/client.h"

namespace truepose::agent {

// Called in the watch's thread.
struct RobotWatchHandlers {
  // `is_snapshot`: as it is at the begin of a watch; else it has just changed.
  std::function<void(const v1::RecalibrationRequest&, bool is_snapshot)> on_request;
  // The snapshot is whole; whether an open request was in it.
  std::function<void(bool has_open_request)> on_snapshot;
  // Settings, latest nominal revision, active calibration: at the begin and when they change.
  std::function<void(const v1::Robot&)> on_robot;
  // A connection broke or none could be made; the reason.
  std::function<void(const absl::Status&)> on_lost;
};

class RobotWatch {
 public:
  RobotWatch(const client::Client& client, std::string robot, RobotWatchHandlers handlers);
  ~RobotWatch();
  RobotWatch(const RobotWatch&) = delete;
  RobotWatch& operator=(const RobotWatch&) = delete;
  void RequestStop() { stop_.Request(); }

 private:
  void RunThread();
  bool Take(const v1::WatchResponse& response);

  const client::Client& client_;
  const std::string robot_;
  const RobotWatchHandlers handlers_;
  Stop stop_;
  bool snapshot_has_open_ = false;
  std::thread thread_;
};

}  // namespace truepose::agent
