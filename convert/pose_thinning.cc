#include "convert/pose_thinning.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "convert/calibrated_model.h"
#include "convert/frames.h"
#include "convert/readings.h"
#include "convert/report.h"
#include "convert/robot.h"
#include "core/base/status_macros.h"
#include "core/planning/pose_thinning.h"

namespace truepose::convert {
namespace {

using Sessions = std::vector<const v1::SessionInput*>;

// One core reading a row, and which row it is.
struct Candidates {
  std::vector<Reading> readings;
  std::vector<RowOf> rows;
};

bool SameRow(const RowOf& a, const RowOf& b) { return a.session == b.session && a.row == b.row; }

// What a new reading at this pose would tell; distances and single coordinates count as points.
Reading CandidateOf(const Reading& reading) {
  Reading candidate = reading;
  const bool kept =
      reading.kind == ObservationKind::kPose || reading.kind == ObservationKind::kPointAxis;
  if (!kept) candidate.kind = ObservationKind::kPoint;
  candidate.placement = candidate.target = 0;
  candidate.offset = -1;
  return candidate;
}

Candidates CandidatesOf(const ReadingsProblem& readings) {
  Candidates candidates;
  for (const Reading& reading : readings.problem.readings) {
    const RowOf& row = readings.rows[static_cast<size_t>(reading.id)];
    if (!candidates.rows.empty() && SameRow(candidates.rows.back(), row)) {
      candidates.readings.back().kind = ObservationKind::kPose;
      continue;
    }
    candidates.readings.push_back(CandidateOf(reading));
    candidates.rows.push_back(row);
  }
  return candidates;
}

Pose FirstFrame(const v1::CalibrationReport& report, v1::ParameterGroup group) {
  for (const v1::FrameEstimate& frame : report.frames())
    if (frame.group() == group) return PoseFrom(frame.pose());
  return {};
}

v1::PoseSetPose PoseOf(const Sessions& sessions, const RowOf& at) {
  const v1::SessionInput& session = *sessions[static_cast<size_t>(at.session)];
  const v1::Reading& row = session.readings(at.row);
  v1::PoseSetPose pose;
  *pose.mutable_joints() =
      row.joints_commanded().empty() ? row.joints_measured() : row.joints_commanded();
  const std::string& name = session.session().name();
  pose.set_label(absl::StrCat(name.empty() ? absl::StrCat("session ", at.session + 1) : name,
                              " row ", at.row));
  return pose;
}

v1::PoseSet PoseSetOf(const Sessions& sessions, const Candidates& candidates,
                      const std::vector<int>& indices) {
  v1::PoseSet set;
  set.set_purpose(v1::POSE_SET_CALIBRATE);
  for (int index : indices)
    *set.add_poses() = PoseOf(sessions, candidates.rows[static_cast<size_t>(index)]);
  std::vector<std::string> names;
  for (const v1::SessionInput* session : sessions) names.push_back(session->session().name());
  set.set_origin(absl::StrCat("thinned from ", absl::StrJoin(names, ", ")));
  return set;
}

// Any reading counts: fixtures and noise of joints change where one may stand, not where to.
v1::CalibrationOptions ReadingOptionsOf(const v1::Calibration& calibration) {
  v1::CalibrationOptions options = calibration.options();
  if (options.joints() == "both") options.clear_joints();
  return options;
}

}  // namespace

absl::StatusOr<ThinnedPoseSet> RunPoseThinning(const v1::Nominal& nominal,
                                               const v1::Calibration& calibration,
                                               const Sessions& sessions, int poses) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Robot robot, RobotFrom(nominal));
  TRUEPOSE_ASSIGN_OR_RETURN(const CalibratedModel calibrated,
                            CalibratedModelFrom(robot, calibration));
  TRUEPOSE_ASSIGN_OR_RETURN(const ReadingsProblem readings,
                            ReadingsFrom(nominal, robot, sessions, ReadingOptionsOf(calibration)));
  const Candidates candidates = CandidatesOf(readings);
  const Problem problem{&calibrated.model, candidates.readings, {""}, {""}};
  Estimate estimate = NominalEstimate(problem);
  estimate.X_MB = {FirstFrame(calibration.report(), v1::BASE)};
  estimate.X_FT = {FirstFrame(calibration.report(), v1::TOOL)};
  const v1::Summary& summary = calibration.report().summary();
  const ModelError error = {summary.model_sd_position_mm() / kMmPerM,
                            summary.model_sd_rotation_deg() / kDegPerRad};
  TRUEPOSE_ASSIGN_OR_RETURN(const ThinnedPoses thinned, ThinPoses(problem, estimate, error, poses));
  return ThinnedPoseSet{PoseSetOf(sessions, candidates, thinned.indices), thinned.parameters,
                        thinned.log_det, thinned.condition};
}

}  // namespace truepose::convert
