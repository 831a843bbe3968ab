#include "server/store/frozen_input.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/store/jobs.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/readings.h"
#include "server/store/robots.h"
#include "server/store/session_row.h"
#include "server/store/sql/query.h"

namespace truepose::store {
namespace {

// Gathers faults of several codes; the answer has the code of the first.
class Faults {
 public:
  void Add(const absl::Status& status, std::string_view field) {
    if (status.ok()) return;
    if (faults_.empty()) code_ = status.code();
    faults_.AddAll(AtField(status, field));
  }
  absl::Status ToStatus() const { return faults_.ToStatus(code_); }

 private:
  FaultList faults_;
  absl::StatusCode code_ = absl::StatusCode::kInvalidArgument;
};

absl::Status CheckSession(const v1::Session& session, const v1::CalibrationJob& job,
                          const std::string& field) {
  FaultList faults;
  if (session.robot() != job.robot())
    faults.Add(field, absl::StrCat("a session of ", session.robot()), job.robot());
  if (session.state() != v1::SEALED) faults.Add(field, "an open session", "a sealed session");
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

absl::StatusOr<FrozenSession> Freeze(Snapshot& snapshot, const v1::CalibrationJob& job, int index) {
  const std::string field = absl::StrCat("sessions[", index, "]");
  for (int earlier = 0; earlier < index; ++earlier) {
    if (job.sessions(earlier) == job.sessions(index)) {
      return FaultStatus(field, job.sessions(index), "each session once");
    }
  }
  TRUEPOSE_ASSIGN_OR_RETURN(const Key key, SessionKey(snapshot, job.sessions(index), field));
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Session session, ReadSession(snapshot, key));
  TRUEPOSE_RETURN_IF_ERROR(CheckSession(session, job, field));
  return FrozenSession{key, session.digest()};
}

absl::Status CheckNominal(Snapshot& snapshot, const v1::CalibrationJob& job) {
  TRUEPOSE_RETURN_IF_ERROR(GetNominalRevision(snapshot, job.nominal_revision()).status());
  TRUEPOSE_ASSIGN_OR_RETURN(const NumberedName name, ParseNominalName(job.nominal_revision()));
  if (RobotName(name.robot_id) == job.robot()) return absl::OkStatus();
  return Refusal(absl::StatusCode::kFailedPrecondition, "name", job.nominal_revision(),
                 absl::StrCat("a revision of ", job.robot()));
}

// A recalibration request is named below its robot; whether there is one its own repository knows.
absl::Status CheckRecalibrationRequest(const v1::CalibrationJob& job) {
  const std::string parent = absl::StrCat(job.robot(), "/recalibrationRequests/");
  const std::string& name = job.recalibration_request();
  if (name.empty() || (name.starts_with(parent) && name.size() > parent.size()))
    return absl::OkStatus();
  return FaultStatus("recalibration_request", name, absl::StrCat(parent, "{request}"));
}

// The form of what says when the job runs.
absl::Status CheckOrder(const v1::CalibrationJob& job) {
  FaultList faults;
  if (job.priority() < kLowestPriority || job.priority() > kHighestPriority)
    faults.Add("priority", absl::StrCat(job.priority()),
               absl::StrCat(kLowestPriority, " to ", kHighestPriority));
  // What google.protobuf.Timestamp allows, from 1970 on.
  constexpr int64_t kYear10000 = 253'402'300'800;
  const auto& deadline = job.deadline();
  if (deadline.seconds() < 0 || deadline.seconds() >= kYear10000 || deadline.nanos() < 0 ||
      deadline.nanos() > 999'999'999) {
    faults.Add("deadline", absl::StrCat(deadline.seconds(), " s and ", deadline.nanos(), " ns"),
               "a time between 1970 and 9999");
  }
  faults.AddAll(CheckRecalibrationRequest(job));
  return faults.ToStatus();
}

absl::StatusOr<v1::CalibrationInput> LoadNominal(Snapshot& snapshot,
                                                 const v1::CalibrationJob& job) {
  v1::CalibrationInput input;
  TRUEPOSE_ASSIGN_OR_RETURN(v1::NominalRevision revision,
                            GetNominalRevision(snapshot, job.nominal_revision()));
  input.set_robot(job.robot());
  input.set_nominal_revision(revision.name());
  *input.mutable_nominal() = std::move(*revision.mutable_nominal());
  *input.mutable_options() = job.options();
  return input;
}

absl::StatusOr<v1::SessionInput> LoadSession(Snapshot& snapshot, const std::string& name,
                                             const std::string& digest) {
  v1::SessionInput input;
  TRUEPOSE_ASSIGN_OR_RETURN(const Key key, SessionKey(snapshot, name));
  TRUEPOSE_ASSIGN_OR_RETURN(*input.mutable_session(), ReadSession(snapshot, key));
  TRUEPOSE_ASSIGN_OR_RETURN(std::vector<v1::Reading> readings, AllReadings(snapshot, name));
  if (input.session().digest() != digest ||
      input.session().reading_count() != static_cast<int>(readings.size())) {
    return absl::DataLossError(absl::StrCat(name, " isn't what the job was created with"));
  }
  for (v1::Reading& reading : readings) *input.add_readings() = std::move(reading);
  return input;
}

}  // namespace

absl::StatusOr<std::vector<FrozenSession>> CheckJobInput(Snapshot& snapshot,
                                                         const v1::CalibrationJob& job) {
  Faults faults;
  faults.Add(GetRobot(snapshot, job.robot()).status(), "robot");
  faults.Add(CheckNominal(snapshot, job), "nominal_revision");
  faults.Add(CheckOrder(job), "priority");
  if (job.sessions().empty() && job.compensation_table().empty())
    faults.Add(FaultStatus("sessions", "none", "at least one"), "sessions");
  std::vector<FrozenSession> sessions;
  for (int i = 0; i < job.sessions_size(); ++i) {
    absl::StatusOr<FrozenSession> session = Freeze(snapshot, job, i);
    faults.Add(session.status(), "sessions");
    if (session.ok()) sessions.push_back(*std::move(session));
  }
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  return sessions;
}

absl::Status CheckDeadline(const v1::CalibrationJob& job, absl::Time now) {
  const absl::Time deadline = DeadlineOf(job);
  if (deadline > now) return absl::OkStatus();
  return Refusal(absl::StatusCode::kFailedPrecondition, "deadline", absl::FormatTime(deadline),
                 absl::StrCat("after ", absl::FormatTime(now)));
}

absl::StatusOr<v1::CalibrationInput> LoadInputNow(Snapshot& snapshot,
                                                  const v1::CalibrationJob& job) {
  TRUEPOSE_ASSIGN_OR_RETURN(v1::CalibrationInput input, LoadNominal(snapshot, job));
  for (const std::string& name : job.sessions()) {
    TRUEPOSE_ASSIGN_OR_RETURN(const Key key, SessionKey(snapshot, name));
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::Session session, ReadSession(snapshot, key));
    TRUEPOSE_ASSIGN_OR_RETURN(*input.add_sessions(), LoadSession(snapshot, name, session.digest()));
  }
  return input;
}

absl::Status FreezeSessions(Transaction& transaction, Key job,
                            const std::vector<FrozenSession>& sessions) {
  for (size_t i = 0; i < sessions.size(); ++i) {
    TRUEPOSE_RETURN_IF_ERROR(sql::Run(
        transaction.sql(),
        "INSERT INTO job_sessions (job, position, session, digest) VALUES ($1, $2, $3, $4)", job, i,
        sessions[i].session, sessions[i].digest));
  }
  return absl::OkStatus();
}

absl::StatusOr<v1::CalibrationInput> LoadJobInput(Snapshot& snapshot,
                                                  const v1::CalibrationJob& job) {
  TRUEPOSE_ASSIGN_OR_RETURN(v1::CalibrationInput input, LoadNominal(snapshot, job));
  TRUEPOSE_ASSIGN_OR_RETURN(const Key key, JobKey(snapshot, job.name()));
  TRUEPOSE_ASSIGN_OR_RETURN(auto rows,
                            sql::Query(snapshot.sql(),
                                       "SELECT sessions.id, job_sessions.digest FROM job_sessions "
                                       "JOIN sessions ON sessions.sequence = job_sessions.session "
                                       "WHERE job_sessions.job = $1 ORDER BY job_sessions.position",
                                       key));
  for (;;) {
    TRUEPOSE_ASSIGN_OR_RETURN(const bool found, rows->Step());
    if (!found) return input;
    TRUEPOSE_ASSIGN_OR_RETURN(*input.add_sessions(),
                              LoadSession(snapshot, SessionName(rows->Text(0)), rows->Text(1)));
  }
}

}  // namespace truepose::store
