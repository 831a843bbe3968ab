// A check session against the active calibration, as messages.
//
// What may be held, and so be attributed, and what is fitted to the check instead:
//   base   of a placement of the check, when its readings share the set-up of a session of the
//          calibration and that session has a base frame for the same placement name of the
//          readings ("" equals ""). Sessions share the set-up when Session.placement is not empty
//          and the same, or Session.fixture is and the calibration found its readings in features
//          of that fixture (then the fixture is M); unless both name an instrument and not the
//          same one. Of several sessions the last counts.
//   tool   of a target of the check, when the calibration has a target of the same name; for
//          readings without one, when a session that shares the set-up has none either.
// A frame that the calibration fitted on its control rows only has no covariance and is not held.
// Unknown constants of distances are always fitted.
//
// Readings are taken as the calibration took its own: what is observed, measured or commanded
// joints, noise of joints, a fixture where the check's rows name features. Parameters that a
// partial recalibration held keep the covariance of the calibration before.
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/recalibration.pb.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::convert {

// @param sessions those of the calibration, in its order, without readings; missing ones share no
// set-up. @param limit_mm the robot's, of the RMS position error; 0 = none.
// @returns a DriftCheck with everything that its readings say: session to limit_exceeded; name,
// times, revision and the request it raises are the caller's.
//   kInvalidArgument with faults of nominal, calibration or `sessions[0].readings...` (the check);
//   kFailedPrecondition when its readings do not determine the frames that are fitted, or are fewer
//   than the changes looked for.
absl::StatusOr<v1::DriftCheck> RunDriftCheck(const v1::Nominal& nominal,
                                             const v1::Calibration& calibration,
                                             const std::vector<v1::Session>& sessions,
                                             const v1::SessionInput& check, double limit_mm = 0);

}  // namespace truepose::convert
