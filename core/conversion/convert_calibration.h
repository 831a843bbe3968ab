// A calibration made in one model, expressed in another: the same robot, other names and values.
//
// Sought are frames and parameters of `to` with
//   X_MB' X_BF'(q, lambda') X_FT' = X_MB X_BF(q, lambda) X_FT   for all q.
// Both models are complete at nominal, so each describes all robots near the nominal one, and a
// solution exists. It is found as an identification: exact full poses of `from` over the joint
// ranges are the readings, the parameters of `to` that generic poses determine are active
// (identifiability.h), the others stay at zero, but for offsets of joints of the same name, which
// keep their value: of the first and last joint they say where B and F stand. What one model counts
// to the links and the other to base or tool moves between lambda and the frames: X_MB' = X_MB G,
// X_FT' = H X_FT with the same G for all placements and the same H for all targets. Effects of
// joints keep their values; they act on the joints as read and take no part.
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "core/identification/problem.h"
#include "core/models/model.h"
#include "core/robot/robot.h"

namespace truepose {

// Distance of the two predictions X_MT, largest over the poses looked at.
struct PredictionGap {
  double position_m = 0;  // at the flange
  double rotation_rad = 0;
};

struct Conversion {
  Estimate estimate;    // of `to`; placements, targets and constants in the order of `from`'s
  PredictionGap worst;  // below 1e-9 m and 1e-9 rad at 200 poses over the joint ranges that the
                        // solution has not seen
  std::vector<int> solved = {};  // parameters of `to` that were solved for: geometric ones that
                                 // generic poses determine; the others are 0 or effects
};

// Joint ranges are the limits; where one is missing, half a turn or 0.5 m from the middle.
// @param from, to of extent kInternal, of this robot. @param calibration of `from`.
// @returns kInvalidArgument with faults when lambda has not as many finite values as `from`
// parameters, a
//   model has other joints than the robot, or an effect of `from` that is not zero is missing in
//   `to`; kFailedPrecondition with a fault `joints[i]` where the form of `to` is singular at link
//   i+1 of this robot (D&H between parallel axes): an error that `to` can't express, or a
//   parameter that ran away, more than 100 times the largest of `from`.
absl::StatusOr<Conversion> ConvertCalibration(const Robot& robot, const Model& from,
                                              const Estimate& calibration, const Model& to);

}  // namespace truepose
