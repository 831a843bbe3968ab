// The open request of each robot, kept in a folder.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/agent/requests/request_file.h"
#include "client/agent/source.h"
#include "client/agent/spool/disk.h"

namespace truepose::agent {

bool IsOpen(v1::RecalibrationState state);

// May be used by many threads at once. Changes are durable when a call returns OK; one that isn't
// leaves the file as it was.
class RequestBook {
 public:
  // Reads `folder`/{robot}.json of each robot; made when it is not there. A file that can't be read
  // counts as none: the server tells of its request again.
  static absl::StatusOr<std::unique_ptr<RequestBook>> Open(const std::string& folder, Disk& disk,
                                                           const std::vector<std::string>& robots);

  // What the server says of a request: an open one takes the place of another one, with nothing
  // fetched or begun for it yet; the one that is here goes when it is not open any more.
  // Of an older revision than the one here it is out of date, unless it is of a snapshot: a server
  // that was restored from an older copy counts from there.
  absl::Status Take(const std::string& robot, const v1::RecalibrationRequest& request,
                    bool is_snapshot = false);
  // The server has no open request of the robot.
  absl::Status Clear(const std::string& robot);
  // Of the request of this name; another one by now is left as it is.
  absl::Status SetPoses(const std::string& robot, const std::string& request,
                        const google::protobuf::RepeatedPtrField<v1::PoseSetPose>& poses);
  absl::Status SetSession(const std::string& robot, const std::string& request,
                          const std::string& session);
  // @returns kNotFound without an open request; kInvalidArgument without a reason.
  absl::Status Decline(const std::string& robot, const std::string& reason);

  std::optional<OpenRequest> Find(const std::string& robot) const;
  // As ReadingSink::Task.
  absl::StatusOr<MeasuringTask> Task(const std::string& robot) const;

 private:
  RequestBook(std::string folder, Disk& disk) : folder_(std::move(folder)), disk_(disk) {}
  std::string PathOf(const std::string& robot) const;
  absl::Status Store(const std::string& robot, OpenRequest changed);
  absl::Status Remove(const std::string& robot);
  OpenRequest* Named(const std::string& robot, const std::string& request);

  const std::string folder_;
  Disk& disk_;
  mutable std::mutex mutex_;
  std::map<std::string, OpenRequest> open_;  // by robot
};

}  // namespace truepose::agent
