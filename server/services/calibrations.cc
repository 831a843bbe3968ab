#include "server/services/calibrations.h"

#include <algorithm>
#include <string>

#include "absl/strings/str_cat.h"
#include "convert/run.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/services/closures.h"
#include "server/store/calibrations.h"
#include "server/store/names.h"
#include "server/store/readings.h"
#include "server/store/robots.h"
#include "server/store/sessions.h"

namespace truepose::services {
namespace {

using store::Snapshot;

// A calibration with the nominal geometry that it corrects.
struct Correction {
  v1::Calibration calibration;
  v1::Nominal nominal;
};

absl::StatusOr<Correction> LoadCorrection(Snapshot& snapshot, const std::string& name) {
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Calibration calibration, store::GetCalibration(snapshot, name));
  TRUEPOSE_ASSIGN_OR_RETURN(v1::NominalRevision revision,
                            store::GetNominalRevision(snapshot, calibration.nominal_revision()));
  return Correction{std::move(calibration), std::move(*revision.mutable_nominal())};
}

// Joints leave the server for a robot only by a calibration that nobody has rejected, of a robot
// that is there. One that is not released yet may be tried.
absl::Status CheckMayMoveARobot(Snapshot& snapshot, const v1::Calibration& calibration) {
  TRUEPOSE_ASSIGN_OR_RETURN(const auto name,
                            store::ParseCalibrationName(calibration.name(), "calibration"));
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot,
                            store::GetRobot(snapshot, store::RobotName(name.robot_id)));
  FaultList faults;
  if (calibration.state() == v1::REJECTED) {
    faults.Add("calibration", absl::StrCat(calibration.name(), ", which is REJECTED"),
               "a calibration that was not rejected");
  }
  if (robot.has_delete_time()) {
    faults.Add("calibration", absl::StrCat(calibration.name(), " of a robot that is deleted"),
               "a calibration of a robot that is not deleted");
  }
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

struct EvaluationInput {
  Correction correction;
  v1::SessionInput session;
};

absl::Status CheckSession(const v1::Session& session, const std::string& calibration) {
  FaultList faults;
  TRUEPOSE_ASSIGN_OR_RETURN(const auto name,
                            store::ParseCalibrationName(calibration, "calibration"));
  const std::string robot = store::RobotName(name.robot_id);
  if (session.robot() != robot) {
    faults.Add("session", absl::StrCat(session.name(), " of ", session.robot()),
               absl::StrCat("a session of ", robot));
  }
  if (session.state() != v1::SEALED) {
    faults.Add("session", absl::StrCat(session.name(), " ", v1::SessionState_Name(session.state())),
               "SEALED");
  }
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

absl::StatusOr<EvaluationInput> LoadEvaluation(Snapshot& snapshot,
                                               const v1::EvaluateRequest& request) {
  EvaluationInput input;
  TRUEPOSE_ASSIGN_OR_RETURN(input.correction, LoadCorrection(snapshot, request.calibration()));
  TRUEPOSE_ASSIGN_OR_RETURN(*input.session.mutable_session(),
                            store::GetSession(snapshot, request.session()));
  TRUEPOSE_RETURN_IF_ERROR(CheckSession(input.session.session(), request.calibration()));
  TRUEPOSE_ASSIGN_OR_RETURN(const auto readings, store::AllReadings(snapshot, request.session()));
  input.session.mutable_readings()->Assign(readings.begin(), readings.end());
  return input;
}

absl::Status CheckRequest(const v1::EvaluateRequest& request) {
  FaultList faults;
  faults.AddAll(store::ParseCalibrationName(request.calibration(), "calibration").status());
  faults.AddAll(store::ParseSessionName(request.session(), "session").status());
  if (!v1::Observe_IsValid(request.observe())) {
    faults.Add("observe", absl::StrCat(request.observe()),
               "POSE, POINT, POINT_AXIS or unspecified");
  }
  return faults.ToStatus();
}

absl::Status CheckRequest(const v1::CompensateRequest& request) {
  FaultList faults;
  faults.AddAll(store::ParseCalibrationName(request.calibration(), "calibration").status());
  if (request.targets_size() > kMostTargets) {
    faults.Add("targets", absl::StrCat(request.targets_size()),
               absl::StrCat("at most ", kMostTargets, " a call"));
  }
  return faults.ToStatus();
}

// More would hold a thread for minutes; a client compares page by page.
constexpr int kMostComparisons = 100;

absl::Status CheckRequest(const v1::CompareCalibrationsRequest& request) {
  FaultList faults;
  if (request.sessions().empty()) faults.Add("sessions", "none", "at least one sealed session");
  if (request.calibrations().empty()) faults.Add("calibrations", "none", "at least one");
  for (int i = 0; i < request.sessions_size(); ++i) {
    const std::string field = absl::StrCat("sessions[", i, "]");
    faults.AddAll(store::ParseSessionName(request.sessions(i), field).status());
  }
  for (int i = 0; i < request.calibrations_size(); ++i) {
    const std::string field = absl::StrCat("calibrations[", i, "]");
    faults.AddAll(store::ParseCalibrationName(request.calibrations(i), field).status());
  }
  if (request.sessions_size() * request.calibrations_size() > kMostComparisons) {
    faults.Add("sessions",
               absl::StrCat(request.sessions_size(), " x ", request.calibrations_size()),
               absl::StrCat("at most ", kMostComparisons, " evaluations a call"));
  }
  return faults.ToStatus();
}

bool HadPart(const v1::Calibration& calibration, const std::string& session) {
  const auto& sessions = calibration.sessions();
  return std::find(sessions.begin(), sessions.end(), session) != sessions.end();
}

}  // namespace

absl::StatusOr<v1::Calibration> GetCalibration(const CallContext& call,
                                               const v1::GetCalibrationRequest& request) {
  return call.store.Read(
      [&](Snapshot& snapshot) { return store::GetCalibration(snapshot, request.name()); });
}

absl::StatusOr<v1::ListCalibrationsResponse> ListCalibrations(
    const CallContext& call, const v1::ListCalibrationsRequest& request) {
  TRUEPOSE_RETURN_IF_ERROR(store::ParseRobotName(request.robot(), "robot").status());
  TRUEPOSE_ASSIGN_OR_RETURN(const auto filter, FilterOf<v1::Calibration>(request));
  TRUEPOSE_ASSIGN_OR_RETURN(auto page, call.store.Read([&](Snapshot& snapshot) {
    return store::ListCalibrations(snapshot, request.robot(), PageOf(request), filter);
  }));
  return ToResponse(std::move(page), &v1::ListCalibrationsResponse::mutable_calibrations);
}

absl::StatusOr<v1::Evaluation> Evaluate(const CallContext& call,
                                        const v1::EvaluateRequest& request) {
  TRUEPOSE_RETURN_IF_ERROR(CheckRequest(request));
  TRUEPOSE_ASSIGN_OR_RETURN(const EvaluationInput input, call.store.Read([&](Snapshot& snapshot) {
    return LoadEvaluation(snapshot, request);
  }));
  const Correction& correction = input.correction;
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Evaluation evaluation,
                            convert::RunEvaluation(correction.nominal, correction.calibration,
                                                   input.session, request.observe()));
  evaluation.set_calibration(request.calibration());
  evaluation.set_session(request.session());
  if (HadPart(correction.calibration, request.session())) {
    evaluation.add_warnings(
        "this session had a part in the calibration: the figures are no independent check");
  }
  return evaluation;
}

absl::StatusOr<v1::CompareCalibrationsResponse> CompareCalibrations(
    const CallContext& call, const v1::CompareCalibrationsRequest& request) {
  TRUEPOSE_RETURN_IF_ERROR(CheckRequest(request));
  v1::CompareCalibrationsResponse response;
  for (const std::string& session : request.sessions()) {
    for (const std::string& calibration : request.calibrations()) {
      v1::EvaluateRequest one;
      one.set_session(session);
      one.set_calibration(calibration);
      one.set_observe(request.observe());
      TRUEPOSE_ASSIGN_OR_RETURN(*response.add_evaluations(), Evaluate(call, one));
    }
  }
  return response;
}

absl::StatusOr<v1::CompensateResponse> Compensate(const CallContext& call,
                                                  const v1::CompensateRequest& request) {
  TRUEPOSE_RETURN_IF_ERROR(CheckRequest(request));
  TRUEPOSE_ASSIGN_OR_RETURN(
      const Correction correction,
      call.store.Read([&](Snapshot& snapshot) -> absl::StatusOr<Correction> {
        TRUEPOSE_ASSIGN_OR_RETURN(Correction loaded,
                                  LoadCorrection(snapshot, request.calibration()));
        TRUEPOSE_RETURN_IF_ERROR(CheckMayMoveARobot(snapshot, loaded.calibration));
        return loaded;
      }));
  return convert::RunCompensation(correction.nominal, correction.calibration, request);
}

}  // namespace truepose::services
