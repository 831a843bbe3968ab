#include "server/services/poses_to_measure.h"

#include <algorithm>
#include <vector>

#include "absl/strings/str_cat.h"
#include "convert/pose_thinning.h"
#include "core/base/fault.h"
#include "server/services/live.h"
#include "server/services/stored_resources.h"
#include "server/store/calibrations.h"
#include "server/store/readings.h"
#include "server/store/robots.h"
#include "server/store/sessions.h"
#include "truepose/v1/recalibration.pb.h"

namespace truepose::services {
namespace {

using store::Snapshot;

constexpr char kField[] = "recalibration_request.pose_set";

// What the active calibration was made of.
struct Measured {
  v1::Nominal nominal;
  v1::Calibration calibration;
  std::vector<v1::SessionInput> sessions;
};

// What there is in the store: either a pose set, or where poses can be taken from.
struct Known {
  std::string pose_set;
  int poses = kDefaultPoses;
  std::optional<Measured> measured;
};

absl::StatusOr<v1::SessionInput> LoadSession(Snapshot& snapshot, const std::string& name) {
  v1::SessionInput input;
  TRUEPOSE_ASSIGN_OR_RETURN(*input.mutable_session(), store::GetSession(snapshot, name));
  TRUEPOSE_ASSIGN_OR_RETURN(const auto readings, store::AllReadings(snapshot, name));
  input.mutable_readings()->Assign(readings.begin(), readings.end());
  return input;
}

absl::StatusOr<Measured> LoadMeasured(Snapshot& snapshot, const std::string& calibration) {
  Measured measured;
  TRUEPOSE_ASSIGN_OR_RETURN(measured.calibration, store::GetCalibration(snapshot, calibration));
  TRUEPOSE_ASSIGN_OR_RETURN(
      v1::NominalRevision revision,
      store::GetNominalRevision(snapshot, measured.calibration.nominal_revision()));
  measured.nominal = std::move(*revision.mutable_nominal());
  for (const std::string& name : measured.calibration.sessions()) {
    TRUEPOSE_ASSIGN_OR_RETURN(v1::SessionInput session, LoadSession(snapshot, name));
    measured.sessions.push_back(std::move(session));
  }
  return measured;
}

// A policy's pose set that was deleted since, or is another robot's, is passed over.
absl::Status TakePolicies(Snapshot& snapshot, const std::string& robot, Known& known) {
  TRUEPOSE_ASSIGN_OR_RETURN(const auto policies,
                            AllOfRobot<v1::RecalibrationPolicy>(snapshot, robot));
  for (const v1::RecalibrationPolicy& policy : policies) {
    if (policy.poses() > 0) known.poses = policy.poses();
    if (!policy.pose_set().starts_with(robot + "/")) continue;
    if (GetLiveResource<v1::PoseSet>(snapshot, policy.pose_set(), kField).ok())
      known.pose_set = policy.pose_set();
  }
  return absl::OkStatus();
}

absl::StatusOr<Known> LoadKnown(Snapshot& snapshot, const std::string& robot_name,
                                const std::string& asked) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Robot robot, GetLiveRobot(snapshot, robot_name, "parent"));
  Known known;
  if (!asked.empty()) {
    TRUEPOSE_RETURN_IF_ERROR(GetLiveResource<v1::PoseSet>(snapshot, asked, kField).status());
    if (!asked.starts_with(robot_name + "/"))
      return FaultStatus(kField, asked, absl::StrCat("a pose set of ", robot_name));
    known.pose_set = asked;
    return known;
  }
  TRUEPOSE_RETURN_IF_ERROR(TakePolicies(snapshot, robot_name, known));
  if (!known.pose_set.empty() || robot.active_calibration().empty()) return known;
  TRUEPOSE_ASSIGN_OR_RETURN(known.measured, LoadMeasured(snapshot, robot.active_calibration()));
  return known;
}

PosesToMeasure Thin(const Measured& measured, int poses) {
  std::vector<const v1::SessionInput*> sessions;
  for (const v1::SessionInput& session : measured.sessions) sessions.push_back(&session);
  const int there = measured.calibration.report().sets().complete().poses();
  auto thinned = convert::RunPoseThinning(measured.nominal, measured.calibration, sessions,
                                          std::min(poses, there));
  PosesToMeasure result;
  if (thinned.ok()) {
    result.thinned = std::move(thinned->pose_set);
  } else {
    result.missing = absl::StrCat("the poses of ", measured.calibration.name(),
                                  " can't be thinned: ", thinned.status().message());
  }
  return result;
}

constexpr char kNeedPoses[] = "type.truepose/need-poses";

}  // namespace

absl::Status NeedPoses() {
  absl::Status status = absl::AbortedError("the poses to measure are not chosen yet");
  status.SetPayload(kNeedPoses, absl::Cord());
  return status;
}

bool IsNeedPoses(const absl::Status& status) { return status.GetPayload(kNeedPoses).has_value(); }

absl::StatusOr<PosesToMeasure> PlanPoses(store::Store& store, const std::string& robot,
                                         const std::string& asked) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Known known, store.Read([&](Snapshot& snapshot) {
    return LoadKnown(snapshot, robot, asked);
  }));
  if (known.measured.has_value()) return Thin(*known.measured, known.poses);
  PosesToMeasure poses;
  poses.pose_set = known.pose_set;
  if (poses.pose_set.empty())
    poses.missing = absl::StrCat(robot, " has no active calibration whose poses could be taken");
  return poses;
}

}  // namespace truepose::services
