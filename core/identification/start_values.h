// Where the instrument and the target stand, found from the readings and the nominal robot, from
// any placement.
//
// One linear start alone ends in a wrong minimum on some real sessions (nearly constant tool
// orientation), so many are tried: for each of a set of target positions on the flange, the base by
// aligning points (Kabsch) and the target's orientation by averaging; and from each of the 24
// axis-parallel target orientations, alternating averages of both orientations, then both positions
// linearly. Readings that are less than a point (distances, single coordinates, planes) give the
// base for a target position by trilateration and by the directions of normals (start_partial.h).
// The best are refined by least squares over base, tool and unknown constants, on at most 60
// readings, and the one with the least cost is refined on all. Further placements and targets
// follow from those known.
//
// What readings leave open by nature is any of the choices, which all give the same robot: turns
// about the line of two anchors, about the normal of a single plane, which side of it is up.
#pragma once

#include <optional>

#include "absl/status/statusor.h"
#include "core/base/hooks.h"
#include "core/identification/problem.h"

namespace truepose {

struct StartOptions {
  std::optional<Pose> X_FT;  // nominal target of the robot file, tried first
  // Frames that are known already and stay as they are in `known`; empty = none.
  Estimate known;
  std::vector<bool> base_known = {}, tool_known = {};
  std::vector<bool> offset_known = {};
};

// @returns base and tool frames and constants at the least cost found, lambda zero.
//   kCancelled; kFailedPrecondition when a placement or target has no reading.
absl::StatusOr<Estimate> FindStart(const Problem& problem, const StartOptions& options,
                                   const Hooks& hooks);

}  // namespace truepose
