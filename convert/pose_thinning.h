// Poses of the active calibration's sessions, thinned to a set to be measured, as messages.
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/plant.pb.h"
#include "truepose/v1/robot.pb.h"
#include "truepose/v1/session.pb.h"

namespace truepose::convert {

struct ThinnedPoseSet {
  // purpose POSE_SET_CALIBRATE, poses in measuring order with labels `SESSION row ROW` (a number
  // counted from 1 for a session without a name), origin "thinned from sessions/..., ...".
  v1::PoseSet pose_set;
  int parameters = 0;  // that all the candidates determine
  double log_det = 0;  // core/planning/pose_thinning.h
  double condition = 0;
};

// Candidates are the rows that the calibration could use, each as what it measured there: a pose
// where a row has an orientation or several points, else a point (with axis). All are taken for one
// placement and one target, the first of the calibration, since the new session will be. Joints of
// the set are the commanded ones where a row has them, else the measured.
// @param sessions those of the calibration.
// @returns kInvalidArgument with faults of nominal, calibration, `sessions[i]...`, or of `poses`
// for a count that is too small or exceeds the candidates; kFailedPrecondition as ThinPoses.
absl::StatusOr<ThinnedPoseSet> RunPoseThinning(const v1::Nominal& nominal,
                                               const v1::Calibration& calibration,
                                               const std::vector<const v1::SessionInput*>& sessions,
                                               int poses);

}  // namespace truepose::convert
