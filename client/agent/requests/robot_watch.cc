#include "client/agent/requests/robot_watch.h"

#include "client/agent/requests/request_book.h"
#include "client/watch.h"

namespace truepose::agent {
namespace {

// Between watches that the server refuses or that find none.
constexpr std::chrono::milliseconds kPause{1'000};

}  // namespace

RobotWatch::RobotWatch(const client::Client& client, std::string robot, RobotWatchHandlers handlers)
    : client_(client), robot_(std::move(robot)), handlers_(std::move(handlers)) {
  thread_ = std::thread([this] { RunThread(); });
}

RobotWatch::~RobotWatch() {
  stop_.Request();
  thread_.join();
}

bool RobotWatch::Take(const v1::WatchResponse& response) {
  for (const v1::WatchEvent& event : response.events()) {
    if (event.has_robot()) handlers_.on_robot(event.robot());
    if (!event.has_recalibration_request()) continue;
    handlers_.on_request(event.recalibration_request(), response.snapshot());
    if (response.snapshot() && IsOpen(event.recalibration_request().state()))
      snapshot_has_open_ = true;
  }
  if (response.snapshot_complete()) {
    handlers_.on_snapshot(snapshot_has_open_);
    snapshot_has_open_ = false;
  }
  return !stop_.requested();
}

void RobotWatch::RunThread() {
  v1::WatchRequest request;
  request.set_robot(robot_);
  request.add_kinds(v1::KIND_ROBOT);
  request.add_kinds(v1::KIND_RECALIBRATION_REQUEST);
  client::FollowOptions options;
  options.is_cancelled = [this] { return stop_.requested(); };
  options.on_reconnect = [this](const absl::Status& why) {
    snapshot_has_open_ = false;
    handlers_.on_lost(why);
  };
  while (!stop_.requested()) {
    snapshot_has_open_ = false;
    const absl::Status status = client::FollowWatch(
        client_, request, [this](const v1::WatchResponse& response) { return Take(response); },
        options);
    if (!stop_.requested()) handlers_.on_lost(status);
    stop_.WaitFor(kPause);
  }
}

}  // namespace truepose::agent
