#include "server/services/drift_checks.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "convert/drift.h"
#include "core/base/fault.h"
#include "server/resource/resource_name.h"
#include "server/services/closures.h"
#include "server/services/live.h"
#include "server/services/poses_to_measure.h"
#include "server/services/recalibration_causes.h"
#include "server/services/stored_resources.h"
#include "server/store/calibrations.h"
#include "server/store/names.h"
#include "server/store/readings.h"
#include "server/store/robots.h"
#include "server/store/sessions.h"

namespace truepose::services {
namespace {

using store::Snapshot;
using store::Transaction;
using Request = v1::CreateDriftCheckRequest;

// All that the check is computed from.
struct Input {
  v1::Nominal nominal;
  v1::Calibration calibration;
  std::vector<v1::Session> sessions;  // of the calibration
  v1::SessionInput check;
  double limit_mm = 0.0;
};

absl::StatusOr<store::ResourceKey> CheckRequest(const Request& request) {
  FaultList faults;
  const auto key = resource::MakeKey(TypeOf<v1::DriftCheck>(), request.parent(),
                                     request.drift_check_id(), "drift_check_id");
  faults.AddAll(key.status());
  const v1::DriftCheck& asked = request.drift_check();
  faults.AddAll(store::ParseSessionName(asked.session(), "drift_check.session").status());
  if (!asked.calibration().empty()) {
    faults.AddAll(
        store::ParseCalibrationName(asked.calibration(), "drift_check.calibration").status());
  }
  if (!faults.empty()) return faults.ToStatus();
  return key;
}

absl::Status CheckUsable(const Request& request, const v1::Robot& robot,
                         const v1::Session& session) {
  const std::string& active = robot.active_calibration();
  const std::string& asked = request.drift_check().calibration();
  FaultList faults;
  if (session.robot() != robot.name()) {
    faults.Add("drift_check.session", absl::StrCat(session.name(), " of ", session.robot()),
               absl::StrCat("a session of ", robot.name()));
  }
  if (session.state() != v1::SEALED) {
    faults.Add("drift_check.session",
               absl::StrCat(session.name(), " ", v1::SessionState_Name(session.state())), "SEALED");
  }
  if (active.empty()) {
    faults.Add("parent", absl::StrCat(robot.name(), ", which has no active calibration"),
               "a robot with one; approve and activate a calibration first");
  } else if (!asked.empty() && asked != active) {
    faults.Add("drift_check.calibration", asked, absl::StrCat(active, ", the active one"));
  }
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

absl::StatusOr<v1::Session> CheckedSession(Snapshot& snapshot, const std::string& name) {
  absl::StatusOr<v1::Session> session = store::GetSession(snapshot, name);
  if (absl::IsNotFound(session.status()) || (session.ok() && session->has_delete_time()))
    return store::NotFound(name, "drift_check.session");
  return session;
}

absl::StatusOr<Input> LoadInput(Snapshot& snapshot, const Request& request) {
  Input input;
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot,
                            GetLiveRobot(snapshot, request.parent(), "parent"));
  TRUEPOSE_ASSIGN_OR_RETURN(*input.check.mutable_session(),
                            CheckedSession(snapshot, request.drift_check().session()));
  TRUEPOSE_RETURN_IF_ERROR(CheckUsable(request, robot, input.check.session()));
  TRUEPOSE_ASSIGN_OR_RETURN(input.calibration,
                            store::GetCalibration(snapshot, robot.active_calibration()));
  TRUEPOSE_ASSIGN_OR_RETURN(
      v1::NominalRevision revision,
      store::GetNominalRevision(snapshot, input.calibration.nominal_revision()));
  input.nominal = std::move(*revision.mutable_nominal());
  for (const std::string& name : input.calibration.sessions()) {
    TRUEPOSE_ASSIGN_OR_RETURN(v1::Session session, store::GetSession(snapshot, name));
    input.sessions.push_back(std::move(session));
  }
  TRUEPOSE_ASSIGN_OR_RETURN(const auto readings,
                            store::AllReadings(snapshot, input.check.session().name()));
  input.check.mutable_readings()->Assign(readings.begin(), readings.end());
  input.limit_mm = robot.limits().drift_rms_mm();
  return input;
}

// The check of this id, when it is of the same session.
absl::StatusOr<std::optional<v1::DriftCheck>> FindRepeat(Snapshot& snapshot,
                                                         const store::ResourceKey& key,
                                                         const v1::DriftCheck& asked) {
  const std::string name = resource::ToName(TypeOf<v1::DriftCheck>(), key);
  absl::StatusOr<v1::DriftCheck> found = GetResource<v1::DriftCheck>(snapshot, name);
  if (absl::IsNotFound(found.status())) return std::optional<v1::DriftCheck>();
  TRUEPOSE_RETURN_IF_ERROR(found.status());
  const bool same_calibration =
      asked.calibration().empty() || asked.calibration() == found->calibration();
  if (asked.session() == found->session() && same_calibration)
    return std::optional(*std::move(found));
  return store::Refusal(absl::StatusCode::kAlreadyExists, "drift_check_id",
                        absl::StrCat(name, " of ", found->session()), "a new UUID");
}

absl::Status CheckStillActive(Snapshot& snapshot, const std::string& robot_name,
                              const std::string& calibration) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot, GetLiveRobot(snapshot, robot_name, "parent"));
  if (robot.active_calibration() == calibration) return absl::OkStatus();
  return store::Refusal(
      absl::StatusCode::kAborted, "drift_check.calibration", calibration,
      absl::StrCat(robot.active_calibration(), ", which became active meanwhile; check again"));
}

absl::Status Raise(Transaction& transaction, const std::string& robot, const PosesToMeasure* poses,
                   v1::DriftCheck& check) {
  TRUEPOSE_ASSIGN_OR_RETURN(const auto cause, CauseOfCheck(transaction, robot, check));
  if (!cause.has_value()) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(const auto raised, RaiseOrNote(transaction, *cause, poses));
  if (raised.has_value()) {
    check.set_recalibration_request(raised->name());
    return absl::OkStatus();
  }
  check.add_findings("a request to recalibrate is open already; this check is noted there");
  return absl::OkStatus();
}

absl::StatusOr<v1::DriftCheck> Store(Transaction& transaction, const store::ResourceKey& key,
                                     const Request& request, v1::DriftCheck check,
                                     const PosesToMeasure* poses) {
  TRUEPOSE_ASSIGN_OR_RETURN(auto repeat, FindRepeat(transaction, key, request.drift_check()));
  if (repeat.has_value()) return *std::move(repeat);
  TRUEPOSE_RETURN_IF_ERROR(CheckStillActive(transaction, request.parent(), check.calibration()));
  // The request names the check before it is stored; both are one commit.
  check.set_name(resource::ToName(TypeOf<v1::DriftCheck>(), key));
  TRUEPOSE_RETURN_IF_ERROR(Raise(transaction, request.parent(), poses, check));
  v1::DriftCheck stored;
  TRUEPOSE_RETURN_IF_ERROR(
      resource::Create(transaction, TypeOf<v1::DriftCheck>(), key, check, "drift_check", stored));
  return stored;
}

absl::StatusOr<v1::DriftCheck> Compute(const CallContext& call, const Request& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Input input, call.store.Read([&](Snapshot& snapshot) {
    return LoadInput(snapshot, request);
  }));
  return convert::RunDriftCheck(input.nominal, input.calibration, input.sessions, input.check,
                                input.limit_mm);
}

}  // namespace

absl::StatusOr<v1::DriftCheck> CreateDriftCheck(const CallContext& call, const Request& request) {
  TRUEPOSE_ASSIGN_OR_RETURN(const store::ResourceKey key, CheckRequest(request));
  TRUEPOSE_ASSIGN_OR_RETURN(std::optional<v1::DriftCheck> check,
                            call.store.Read([&](Snapshot& snapshot) {
                              return FindRepeat(snapshot, key, request.drift_check());
                            }));
  if (!check.has_value()) {
    TRUEPOSE_ASSIGN_OR_RETURN(check, Compute(call, request));
  }
  return WithPoses(call.store, request.parent(), [&](const PosesToMeasure* poses) {
    return WriteOnce(call, request, [&](Transaction& transaction) {
      return Store(transaction, key, request, *check, poses);
    });
  });
}

}  // namespace truepose::services
