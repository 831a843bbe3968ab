#include "client/agent/requests/request_book.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <sstream>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

absl::StatusOr<OpenRequest> ReadFile(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return OpenRequestFromJson(text.str());
}

absl::Status NoneOpen(const std::string& robot) {
  return absl::NotFoundError(robot + " has no open recalibration request that is known here");
}

}  // namespace

bool IsOpen(v1::RecalibrationState state) {
  return state >= v1::REQUEST_PENDING && state <= v1::REQUEST_CALIBRATING;
}

absl::StatusOr<std::unique_ptr<RequestBook>> RequestBook::Open(
    const std::string& folder, Disk& disk, const std::vector<std::string>& robots) {
  if (mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) return DiskError(folder);
  std::unique_ptr<RequestBook> book(new RequestBook(folder, disk));
  for (const std::string& robot : robots) {
    const auto open = ReadFile(book->PathOf(robot));
    if (open.ok()) book->open_[robot] = *open;
  }
  return book;
}

std::string RequestBook::PathOf(const std::string& robot) const {
  return absl::StrCat(folder_, "/", robot.substr(robot.find('/') + 1), ".json");
}

absl::Status RequestBook::Store(const std::string& robot, OpenRequest changed) {
  TRUEPOSE_RETURN_IF_ERROR(ReplaceFile(disk_, PathOf(robot), ToJson(changed)));
  open_[robot] = std::move(changed);
  return absl::OkStatus();
}

absl::Status RequestBook::Remove(const std::string& robot) {
  if (open_.erase(robot) == 0) return absl::OkStatus();
  unlink(PathOf(robot).c_str());
  return SyncFolder(disk_, folder_);
}

OpenRequest* RequestBook::Named(const std::string& robot, const std::string& request) {
  const auto found = open_.find(robot);
  return found != open_.end() && found->second.request.name() == request ? &found->second : nullptr;
}

absl::Status RequestBook::Take(const std::string& robot, const v1::RecalibrationRequest& request,
                               bool is_snapshot) {
  std::lock_guard lock(mutex_);
  OpenRequest* const known = Named(robot, request.name());
  if (!IsOpen(request.state())) return known == nullptr ? absl::OkStatus() : Remove(robot);
  // Answers and the watch overtake each other.
  if (known != nullptr && !is_snapshot && request.revision() < known->request.revision())
    return absl::OkStatus();
  OpenRequest changed = known != nullptr ? *known : OpenRequest();
  // What was fetched was another set, should it be changed.
  if (changed.request.pose_set() != request.pose_set()) changed.has_poses = false;
  const bool only_progress = known != nullptr && known->request.state() == request.state() &&
                             changed.request.pose_set() == request.pose_set();
  changed.request = request;
  if (!only_progress) return Store(robot, std::move(changed));
  *known = std::move(changed);
  return absl::OkStatus();
}

absl::Status RequestBook::Clear(const std::string& robot) {
  std::lock_guard lock(mutex_);
  return Remove(robot);
}

absl::Status RequestBook::SetPoses(
    const std::string& robot, const std::string& request,
    const google::protobuf::RepeatedPtrField<v1::PoseSetPose>& poses) {
  std::lock_guard lock(mutex_);
  const OpenRequest* const known = Named(robot, request);
  if (known == nullptr) return absl::OkStatus();
  OpenRequest changed = *known;
  changed.has_poses = true;
  changed.poses.assign(poses.begin(), poses.end());
  return Store(robot, std::move(changed));
}

absl::Status RequestBook::SetSession(const std::string& robot, const std::string& request,
                                     const std::string& session) {
  std::lock_guard lock(mutex_);
  const OpenRequest* const known = Named(robot, request);
  if (known == nullptr || known->session == session) return absl::OkStatus();
  OpenRequest changed = *known;
  changed.session = session;
  return Store(robot, std::move(changed));
}

absl::Status RequestBook::Decline(const std::string& robot, const std::string& reason) {
  if (reason.empty()) return FaultStatus("reason", "nothing", "why the robot is not recalibrated");
  std::lock_guard lock(mutex_);
  const auto found = open_.find(robot);
  if (found == open_.end()) return NoneOpen(robot);
  OpenRequest changed = found->second;
  changed.decline_reason = reason;
  return Store(robot, std::move(changed));
}

std::optional<OpenRequest> RequestBook::Find(const std::string& robot) const {
  std::lock_guard lock(mutex_);
  const auto found = open_.find(robot);
  return found == open_.end() ? std::nullopt : std::optional(found->second);
}

absl::StatusOr<MeasuringTask> RequestBook::Task(const std::string& robot) const {
  const auto open = Find(robot);
  if (!open.has_value() || !open->decline_reason.empty()) return NoneOpen(robot);
  return MeasuringTask{.request = open->request.name(),
                       .reason = open->request.reason(),
                       .pose_set = open->request.pose_set(),
                       .poses = open->poses,
                       .session = open->session};
}

}  // namespace truepose::agent
