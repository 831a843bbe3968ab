#include "client/agent/requests/request_keeper.h"

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "truepose/v1/plant_requests.pb.h"

namespace truepose::agent {
namespace {

constexpr std::chrono::milliseconds kPause{100};

const char* NameOf(StepKind step) {
  switch (step) {
    case StepKind::kNone:
      return "nothing";
    case StepKind::kFetchPoses:
      return "fetch its poses";
    case StepKind::kAcknowledge:
      return "acknowledge";
    case StepKind::kReport:
      return "report";
    case StepKind::kCalibrate:
      return "calibrate";
    case StepKind::kDecline:
      return "decline";
  }
  return "";
}

}  // namespace

RequestKeeper::RequestKeeper(RequestKeeperOptions options, RequestBook& book, Spool& spool,
                             const client::Client& client,
                             std::function<void(const std::string&)> log)
    : options_(std::move(options)),
      book_(book),
      spool_(spool),
      client_(client),
      log_(std::move(log)) {
  thread_ = std::thread([this] { RunThread(); });
}

RequestKeeper::~RequestKeeper() {
  RequestStop();
  thread_.join();
}

void RequestKeeper::Notify() {
  std::lock_guard lock(mutex_);
  notified_ = true;
  changed_.notify_all();
}

void RequestKeeper::RequestStop() {
  std::lock_guard lock(mutex_);
  stopping_ = true;
  changed_.notify_all();
}

bool RequestKeeper::Wait() {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, options_.interval, [this] { return notified_ || stopping_; });
  notified_ = false;
  return !stopping_;
}

// Readings come faster than they are worth a report each, and a server that is away is not asked
// more often than needed.
void RequestKeeper::Pause() {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, kPause, [this] { return stopping_; });
}

void RequestKeeper::RunThread() {
  while (Wait()) {
    for (const std::string& robot : options_.robots) {
      const absl::Status status = Keep(robot);
      std::string& problem = problems_[robot];
      const std::string found(status.message());
      if (!status.ok() && found != problem) log_(absl::StrCat(robot, ": ", found));
      problem = found;
    }
    options_.after_pass();
    Pause();
  }
}

RequestSession RequestKeeper::SessionOf(const std::string& name) const {
  RequestSession session;
  session.settled = spool_.IsDone(name);
  if (const Spool::Session file = spool_.Find(name); file != nullptr)
    session.delivered = std::max<int64_t>(0, file->delivered);
  return session;
}

void RequestKeeper::FindSession(const std::string& robot, OpenRequest& open) {
  for (const Spool::Session& session : spool_.Sessions()) {
    if (session->request() != open.request.name() || session->content().name() == open.session ||
        session->sealed())
      continue;
    open.session = session->content().name();
    book_.SetSession(robot, open.request.name(), open.session).IgnoreError();
  }
}

absl::Status RequestKeeper::Keep(const std::string& robot) {
  for (int step = 0; step < 4; ++step) {
    auto open = book_.Find(robot);
    if (!open.has_value()) return absl::OkStatus();
    FindSession(robot, *open);
    const RequestSession session = SessionOf(open->session);
    const StepKind next = NextStep(*open, session, options_.steps);
    if (next == StepKind::kNone) return absl::OkStatus();
    const absl::Status made = Make(next, robot, *open, session);
    if (!made.ok())
      return absl::Status(made.code(), absl::StrCat(open->request.name(), ", to ", NameOf(next),
                                                    ": ", std::string(made.message())));
    if (next != StepKind::kReport || open->request.state() != v1::REQUEST_MEASURING)
      log_(absl::StrCat(open->request.name(), ": ", NameOf(next)));
  }
  return absl::OkStatus();
}

absl::Status RequestKeeper::FetchPoses(const std::string& robot, const OpenRequest& open) {
  v1::GetPoseSetRequest request;
  request.set_name(open.request.pose_set());
  v1::PoseSet poses;
  TRUEPOSE_RETURN_IF_ERROR(
      client_.CallMethod("truepose.v1.PlantService/GetPoseSet", request, &poses));
  return book_.SetPoses(robot, open.request.name(), poses.poses());
}

// The answer is the request as it is then. A step that was made already, its answer lost, is
// refused; the watch tells of the state that it led to.
absl::Status RequestKeeper::Make(StepKind step, const std::string& robot, const OpenRequest& open,
                                 const RequestSession& session) {
  absl::StatusOr<v1::RecalibrationRequest> changed = open.request;
  const auto named = [&](auto request) {
    request.set_name(open.request.name());
    return request;
  };
  if (step == StepKind::kFetchPoses) return FetchPoses(robot, open);
  if (step == StepKind::kAcknowledge) {
    changed = client_.AcknowledgeRecalibration(named(v1::AcknowledgeRecalibrationRequest()));
  } else if (step == StepKind::kCalibrate) {
    changed = client_.CalibrateForRequest(named(v1::CalibrateForRequestRequest()));
  } else if (step == StepKind::kDecline) {
    v1::DeclineRecalibrationRequest request = named(v1::DeclineRecalibrationRequest());
    request.set_reason(open.decline_reason);
    changed = client_.DeclineRecalibration(request);
  } else {
    v1::ReportMeasuringRequest request = named(v1::ReportMeasuringRequest());
    request.set_session(open.session);
    request.set_readings_taken(static_cast<int>(session.delivered));
    changed = client_.ReportMeasuring(request);
  }
  TRUEPOSE_RETURN_IF_ERROR(changed.status());
  return book_.Take(robot, *changed);
}

}  // namespace truepose::agent
