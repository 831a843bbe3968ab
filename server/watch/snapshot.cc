#include "server/watch/snapshot.h"

#include <utility>

#include "core/base/status_macros.h"
#include "google/protobuf/descriptor.h"
#include "server/store/calibrations.h"
#include "server/store/jobs.h"
#include "server/store/names.h"
#include "server/store/resources.h"
#include "server/store/robots.h"
#include "server/store/sessions.h"

namespace truepose::watch {
namespace {

using store::Page;
using store::PageRequest;
using store::Snapshot;

constexpr int kPageSize = 50;

struct Source {
  Snapshot& snapshot;
  const store::EventFilter& filter;
  PageRequest page;
  std::vector<v1::WatchEvent> events;

  std::string RobotNameOrAll() const {
    return filter.robot_id.empty() ? "" : store::RobotName(filter.robot_id);
  }
};

// Takes a state into the page unless it is another resource than the one asked for.
template <typename T>
absl::Status Take(Source& source, v1::ResourceKind kind, const T& state) {
  if (!source.filter.name.empty() && source.filter.name != state.name()) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(
      v1::WatchEvent event,
      store::ToWatchEvent(state.revision(),
                          {.kind = kind, .robot_id = "", .name = state.name(), .deleted = false},
                          state.SerializeAsString()));
  source.events.push_back(std::move(event));
  return absl::OkStatus();
}

template <typename T, typename IsCurrent>
absl::StatusOr<std::string> TakePage(Source& source, v1::ResourceKind kind, const Page<T>& page,
                                     IsCurrent is_current) {
  for (const T& item : page.items) {
    const bool asked_by_name = source.filter.name == item.name();
    if (asked_by_name || is_current(item)) TRUEPOSE_RETURN_IF_ERROR(Take(source, kind, item));
  }
  return page.next_page_token;
}

absl::StatusOr<std::string> ReadRobots(Source& source) {
  if (!source.filter.robot_id.empty()) {
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot,
                              store::GetRobot(source.snapshot, source.RobotNameOrAll()));
    TRUEPOSE_RETURN_IF_ERROR(Take(source, v1::KIND_ROBOT, robot));
    return std::string();
  }
  TRUEPOSE_ASSIGN_OR_RETURN(const Page<v1::Robot> page,
                            store::ListRobots(source.snapshot, source.page));
  return TakePage(source, v1::KIND_ROBOT, page, [](const v1::Robot&) { return true; });
}

absl::StatusOr<std::string> ReadSessions(Source& source) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      const Page<v1::Session> page,
      store::ListSessions(source.snapshot, source.RobotNameOrAll(), source.page));
  return TakePage(source, v1::KIND_SESSION, page,
                  [](const v1::Session& session) { return session.state() == v1::OPEN; });
}

absl::StatusOr<std::string> ReadJobs(Source& source) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Page<v1::CalibrationJob> page,
                            store::ListJobs(source.snapshot, source.RobotNameOrAll(), source.page));
  return TakePage(source, v1::KIND_JOB, page, [](const v1::CalibrationJob& job) {
    return job.state() == v1::PENDING || job.state() == v1::RUNNING;
  });
}

// Of each robot of the page the one that is active.
absl::StatusOr<std::string> ReadCalibrations(Source& source) {
  Page<v1::Robot> robots;
  if (source.filter.robot_id.empty()) {
    TRUEPOSE_ASSIGN_OR_RETURN(robots, store::ListRobots(source.snapshot, source.page));
  } else {
    TRUEPOSE_ASSIGN_OR_RETURN(v1::Robot robot,
                              store::GetRobot(source.snapshot, source.RobotNameOrAll()));
    robots.items.push_back(std::move(robot));
  }
  for (const v1::Robot& robot : robots.items) {
    if (robot.active_calibration().empty()) continue;
    TRUEPOSE_ASSIGN_OR_RETURN(v1::Calibration calibration,
                              store::GetCalibration(source.snapshot, robot.active_calibration()));
    calibration.clear_residuals();
    calibration.clear_covariance();
    TRUEPOSE_RETURN_IF_ERROR(Take(source, v1::KIND_CALIBRATION, calibration));
  }
  return robots.next_page_token;
}

bool IsEnded(const v1::WatchEvent& event) {
  if (!event.has_recalibration_request()) return false;
  const v1::RecalibrationState state = event.recalibration_request().state();
  return state == v1::REQUEST_DONE || state == v1::REQUEST_DECLINED || state == v1::REQUEST_EXPIRED;
}

absl::StatusOr<bool> TakeStored(Source& source, v1::ResourceKind kind, const std::string& bytes) {
  TRUEPOSE_ASSIGN_OR_RETURN(
      v1::WatchEvent event,
      store::ToWatchEvent(0, {.kind = kind, .robot_id = "", .name = "", .deleted = false}, bytes));
  const auto* reflection = event.GetReflection();
  const auto* field = reflection->GetOneofFieldDescriptor(
      event, v1::WatchEvent::descriptor()->FindOneofByName("resource"));
  const google::protobuf::Message& state = reflection->GetMessage(event, field);
  const auto* descriptor = state.GetDescriptor();
  event.set_name(state.GetReflection()->GetString(state, descriptor->FindFieldByName("name")));
  event.set_revision(
      state.GetReflection()->GetInt64(state, descriptor->FindFieldByName("revision")));
  const bool named = source.filter.name == event.name();
  if (named || (source.filter.name.empty() && !IsEnded(event)))
    source.events.push_back(std::move(event));
  return true;
}

absl::StatusOr<std::string> ReadStored(Source& source, v1::ResourceKind kind) {
  const store::ResourceList list{.kind = kind,
                                 .robot_id = source.filter.robot_id.empty()
                                                 ? std::nullopt
                                                 : std::optional(source.filter.robot_id),
                                 .show_deleted = false,
                                 .filter = ""};
  return store::ListResources(source.snapshot, list, source.page, [&](const std::string& bytes) {
    return TakeStored(source, kind, bytes);
  });
}

absl::StatusOr<std::string> ReadKind(Source& source, v1::ResourceKind kind) {
  switch (kind) {
    case v1::KIND_ROBOT:
      return ReadRobots(source);
    case v1::KIND_SESSION:
      return ReadSessions(source);
    case v1::KIND_JOB:
      return ReadJobs(source);
    case v1::KIND_CALIBRATION:
      return ReadCalibrations(source);
    default:
      return ReadStored(source, kind);
  }
}

std::vector<v1::ResourceKind> KindsOf(const store::EventFilter& filter) {
  std::vector<v1::ResourceKind> kinds;
  for (int i = v1::ResourceKind_MIN + 1; i <= v1::ResourceKind_MAX; ++i) {
    const auto kind = static_cast<v1::ResourceKind>(i);
    if (filter.kinds.empty() || filter.kinds.contains(kind)) kinds.push_back(kind);
  }
  return kinds;
}

}  // namespace

SnapshotReader::SnapshotReader(store::EventFilter filter)
    : filter_(std::move(filter)), kinds_(KindsOf(filter_)) {}

absl::StatusOr<std::vector<v1::WatchEvent>> SnapshotReader::NextPage(store::Snapshot& snapshot) {
  Source source{snapshot, filter_, {kPageSize, page_token_}, {}};
  TRUEPOSE_ASSIGN_OR_RETURN(next_token_, ReadKind(source, kinds_[kind_]));
  return std::move(source.events);
}

void SnapshotReader::Advance() {
  page_token_ = next_token_;
  if (page_token_.empty()) ++kind_;
}

}  // namespace truepose::watch
