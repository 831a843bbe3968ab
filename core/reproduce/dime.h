// The dime of Sec. 11.3: a block with 72 holes whose places and directions are known, into which
// the pin of the measuring robot is put; 9 holes are met in a second configuration of the wrist, 81
// poses in all. The chapter does not publish the holes: these are of the same design and cover the
// same sort of working area.
//
// 18 sites, x 360, 450, 540, y -180, 0, 180, z 60, 170 mm in M, four holes each: straight down; the
// pin leaning towards the robot and away from it, by 15 deg at the lower sites and 20 deg at the
// upper ones; and 40 deg to the left or right, in turn.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "absl/status/statusor.h"
#include "core/models/model.h"

namespace truepose {

struct Hole {
  Eigen::Vector3d p_M;     // where the pin's tip comes to rest
  Eigen::Vector3d axis_M;  // unit; where the pin points, z of T
};

struct DimePose {
  Hole hole;
  bool flipped = false;  // q4 half a turn on, q5 on its other side: the same pin
};

// The 72 holes, then 9 of them again, flipped.
std::vector<DimePose> Dime();

// The least |cos q5| over the dime is above this: near 0 the pin lines up with the forearm, and q4
// can't be told from q1 .. q3.
inline constexpr double kLeastCosineOfWrist = 0.15;

// Joints at which the *nominal* measuring robot's pin is in the hole, elbow up, in closed form.
// @returns kFailedPrecondition when the hole is out of reach.
absl::StatusOr<Eigen::VectorXd> NominalJoints(const DimePose& pose);

// The same of any parameters, by Newton on the tip's position and the pin's direction from the
// nominal joints.
// @returns kFailedPrecondition when the hole is out of reach or Newton does not arrive.
absl::StatusOr<Eigen::VectorXd> JointsAt(const Model& measuring_robot,
                                         const Eigen::VectorXd& lambda, const DimePose& pose);

}  // namespace truepose
