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
  if (job.sessions().empty())
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
  v1::CalibrationInput input;
  TRUEPOSE_ASSIGN_OR_RETURN(v1::NominalRevision revision,
                            GetNominalRevision(snapshot, job.nominal_revision()));
  TRUEPOSE_ASSIGN_OR_RETURN(const Key key, JobKey(snapshot, job.name()));
  input.set_robot(job.robot());
  input.set_nominal_revision(revision.name());
  *input.mutable_nominal() = std::move(*revision.mutable_nominal());
  *input.mutable_options() = job.options();
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
