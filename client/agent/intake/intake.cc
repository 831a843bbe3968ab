#include "client/agent/intake/intake.h"

#include <algorithm>
#include <ctime>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "client/agent/intake/reading_check.h"
#include "client/agent/intake/session_check.h"
#include "client/uuid.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

constexpr char kSessions[] = "sessions/";

absl::Status Refusal(absl::StatusCode code, const char* field, const std::string& found,
                     const std::string& expected) {
  FaultList faults;
  faults.Add(field, found, expected);
  return faults.ToStatus(code);
}

SessionProgress ProgressOf(const SessionFile& session) {
  SessionProgress progress;
  progress.session = session.content().name();
  progress.robot = session.content().robot();
  progress.readings = session.readings();
  progress.sealed = session.sealed();
  progress.delivered = std::max<int64_t>(0, session.delivered);
  progress.refusal = session.refusal();
  return progress;
}

// What a source says, without what the server sets.
v1::Session ContentOf(const v1::Session& said) {
  v1::Session content = said;
  content.clear_state();
  content.clear_reading_count();
  content.clear_digest();
  content.clear_seal_time();
  content.clear_revision();
  content.clear_etag();
  content.clear_sealed_by();
  content.clear_created_by();
  content.clear_update_time();
  content.clear_delete_time();
  content.clear_certificate_expired_time();
  content.mutable_create_time()->set_seconds(std::time(nullptr));
  return content;
}

}  // namespace

Intake::Intake(IntakeOptions options, Spool& spool, RequestBook& requests,
               std::function<void()> on_change)
    : options_(std::move(options)),
      spool_(spool),
      requests_(requests),
      on_change_(std::move(on_change)) {}

absl::StatusOr<int> Intake::JointsOf(const std::string& robot) const {
  const auto found = options_.joints.find(robot);
  if (found != options_.joints.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [name, joints] : options_.joints) names.push_back(name);
  return Refusal(absl::StatusCode::kNotFound, "robot", absl::StrCat("'", robot, "'"),
                 absl::StrCat("one of this agent's configuration: ", absl::StrJoin(names, ", ")));
}

absl::StatusOr<std::string> Intake::NameFor(const SessionStart& start) const {
  if (!start.key.empty()) {
    return kSessions + client::NamedUuid(absl::StrCat(options_.agent, "\n", start.content.robot(),
                                                      "\n", start.key));
  }
  if (start.id.empty()) return kSessions + client::RandomUuid();
  if (IsUuid(start.id)) return kSessions + start.id;
  return FaultStatus("id", absl::StrCat("'", start.id, "'"), "a UUID in lower case");
}

absl::StatusOr<SessionProgress> Intake::Begin(const SessionStart& start) {
  TRUEPOSE_RETURN_IF_ERROR(JointsOf(start.content.robot()).status());
  TRUEPOSE_RETURN_IF_ERROR(CheckSession(start.content));
  if ((start.id.empty() ? 0 : 1) + (start.key.empty() ? 0 : 1) + (start.for_request ? 1 : 0) > 1)
    return FaultStatus("id", "more than one", "at most one of id, key and request");
  v1::Session content = ContentOf(start.content);
  if (start.for_request) return BeginForRequest(std::move(content));
  TRUEPOSE_ASSIGN_OR_RETURN(*content.mutable_name(), NameFor(start));
  // What is done already is found, too: a source that broke off may begin again with it.
  if (spool_.IsDone(content.name())) return Progress(content.name());
  // A key stands for all that its file says.
  if (!start.key.empty() && spool_.Find(content.name()) != nullptr) return Progress(content.name());
  return BeginNamed(std::move(content), "");
}

absl::StatusOr<SessionProgress> Intake::BeginNamed(v1::Session content,
                                                   const std::string& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(const auto session, spool_.Begin(content, request));
  return ProgressOf(*session);
}

absl::StatusOr<SessionProgress> Intake::BeginForRequest(v1::Session content) {
  TRUEPOSE_ASSIGN_OR_RETURN(const MeasuringTask task, requests_.Task(content.robot()));
  if (const Spool::Session open = OpenSessionOf(task.request); open != nullptr)
    return ProgressOf(*open);
  content.set_name(kSessions + client::RandomUuid());
  const std::string robot = content.robot(), name = content.name();
  TRUEPOSE_ASSIGN_OR_RETURN(const SessionProgress begun,
                            BeginNamed(std::move(content), task.request));
  // A crash in between is made good by who keeps the requests: the session's file names its
  // request.
  TRUEPOSE_RETURN_IF_ERROR(requests_.SetSession(robot, task.request, name));
  return begun;
}

Spool::Session Intake::OpenSessionOf(const std::string& request) const {
  Spool::Session newest;
  for (const Spool::Session& session : spool_.Sessions())
    if (session->request() == request && !session->sealed()) newest = session;
  return newest;
}

absl::StatusOr<Spool::Session> Intake::Find(const std::string& session) const {
  Spool::Session found = spool_.Find(session);
  if (found != nullptr) return found;
  if (spool_.IsDone(session))
    return Refusal(absl::StatusCode::kFailedPrecondition, "session",
                   session + ", which is sealed and delivered", "an open session");
  return Refusal(absl::StatusCode::kNotFound, "session", absl::StrCat("'", session, "'"),
                 "a session that was begun with this agent");
}

absl::StatusOr<int64_t> Intake::Append(const std::string& session, int64_t first_number,
                                       const std::vector<v1::Reading>& readings) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Spool::Session found, Find(session));
  TRUEPOSE_ASSIGN_OR_RETURN(const int joints, JointsOf(found->content().robot()));
  FaultList faults;
  for (size_t i = 0; i < readings.size(); ++i)
    CheckReading(readings[i], joints, absl::StrCat("readings[", i, "]"), &faults);
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  TRUEPOSE_ASSIGN_OR_RETURN(const int64_t has, found->Append(first_number, readings));
  on_change_();
  return has;
}

absl::StatusOr<SessionProgress> Intake::Seal(const std::string& session, int64_t readings) {
  if (spool_.IsDone(session)) return Progress(session);
  TRUEPOSE_ASSIGN_OR_RETURN(const Spool::Session found, Find(session));
  TRUEPOSE_RETURN_IF_ERROR(found->Seal(readings));
  on_change_();
  return ProgressOf(*found);
}

absl::StatusOr<MeasuringTask> Intake::Task(const std::string& robot) {
  TRUEPOSE_RETURN_IF_ERROR(JointsOf(robot).status());
  TRUEPOSE_ASSIGN_OR_RETURN(MeasuringTask task, requests_.Task(robot));
  if (const Spool::Session open = OpenSessionOf(task.request); open != nullptr)
    task.session = open->content().name();
  return task;
}

absl::StatusOr<SessionProgress> Intake::Progress(const std::string& session) const {
  if (const Spool::Session found = spool_.Find(session); found != nullptr)
    return ProgressOf(*found);
  if (!spool_.IsDone(session)) return Find(session).status();
  SessionProgress progress;
  progress.session = session;
  progress.sealed = progress.settled = true;
  TRUEPOSE_ASSIGN_OR_RETURN(progress.readings, spool_.DoneReadings(session));
  progress.delivered = progress.readings;
  return progress;
}

}  // namespace truepose::agent
