// What a compensation table is asked to cover, and how well.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include "absl/status/status.h"
#include "compensation/arm.h"
#include "core/geometry/pose.h"

namespace truepose {

// Places of a tool: T within a box of B, its z axis within a cone about `approach_B`, turned about
// that axis by `roll`, the arm in one configuration.
//
// Orientations are R_BT = Exp(v) R_0 R(z, roll) with v perpendicular to the approach, |v| <= cone,
// and R_0 the tool's orientation at `reference`, turned the shortest way until its z axis is the
// approach. For an arm of fewer than six joints roll has no part (pose_finder.h).
struct BoxDomain {
  Eigen::AlignedBox3d box_B;  // m
  Pose X_FT;                  // identity: the flange itself
  Eigen::Vector3d approach_B = -Eigen::Vector3d::UnitZ();
  double cone_rad = 0;  // 0 to pi
  double roll_lower_rad = -std::numbers::pi, roll_upper_rad = std::numbers::pi;
  Eigen::VectorXd reference;  // controller joints that pick the configuration
};

struct TableSpec {
  // Where it holds: the box, else `ranges` of the controller joints, else the robot's limits, with
  // +-pi for a revolute joint that has none.
  std::optional<BoxDomain> box;
  std::vector<compensation::JointLimits> ranges;

  // Most that the table may add to exact compensation, of the flange: a tool of length l is off by
  // l * rotation more.
  double position_tolerance_m = 2e-5;
  double rotation_tolerance_rad = 8.7e-5;  // 0.005 deg
  // Where the smallest singular value of the nominal Jacobian (lengths / characteristic length) is
  // below this the table refuses: joint corrections grow as its inverse.
  double smallest_singular_value = 0.05;
  int verification_points = 10000;
  int64_t largest_bytes = int64_t{64} << 20;
  uint64_t seed = 1;  // equal seeds, equal bytes
};

// What decides in the runtime is right to 1e-8.
inline constexpr double kLeastSingularValue = 1e-6;

// Every fault of the spec for this arm, fields as `joint_ranges.joints[1]`, `box.cone_rad`: of
// ranges in the wrong order or beyond the arm's limits, a prismatic joint without any, an empty
// box, an approach without direction, reference joints of another count, tolerances that are not
// above 1e-9, a smallest singular value below
// kLeastSingularValue, points below 1000, bytes above 64 MiB.
absl::Status Validate(const TableSpec& spec, const compensation::Arm& arm);

}  // namespace truepose
