// The predicted accuracy of a compensated tool over a volume.
#pragma once

#include <array>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/hooks.h"
#include "core/compensation/pose_finder.h"
#include "core/compensation/tool_accuracy.h"

namespace truepose {

struct AccuracyMapSpec {
  // Its box, approach, tool and reference joints; cone and roll have no part: the tool's z axis is
  // the approach everywhere, turned about it as at the reference joints.
  BoxDomain box;
  std::array<int, 3> points = {13, 13, 3};  // along x, y and z of B, each at least 1
};

struct AccuracyPoint {
  Eigen::Vector3d p_BT;  // m
  bool reached =
      false;      // in the configuration of the reference joints; else nothing below is meant
  JointVector q;  // controller joints, nominal
  ToolAccuracy accuracy;
};

struct AccuracyMap {
  std::vector<AccuracyPoint> points;  // x fastest, then y, then z
  int reached = 0;
  double rms_m = 0;            // root mean square over the points that are reached
  double position_95_m = 0;    // 95 % of errors over all of them are shorter
  size_t best = 0, worst = 0;  // of these, by position_95_m
};

// @returns kInvalidArgument with faults of the spec (`points`, `box...`); kFailedPrecondition with
// a fault when no point is reached; kCancelled.
absl::StatusOr<AccuracyMap> MapAccuracy(const compensation::Arm& arm,
                                        const AccuracySources& sources, const AccuracyMapSpec& spec,
                                        const Hooks& hooks);

}  // namespace truepose
