// Where the axes of the nominal joints are.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/robot/robot.h"

namespace truepose {

// The line p + t u in B with all chain joints at zero. Of a prismatic joint only u matters: its
// motion is the same along any parallel line.
struct AxisLine {
  Eigen::Vector3d u;  // unit, along the positive motion
  Eigen::Vector3d p;  // m
};

// A line a joint, through the origin of the frame in which the chain moves it.
std::vector<AxisLine> AxisLines(const Robot& robot);

// sin of the angle between axes below which they count as parallel, also in opposite directions:
// 0.1 (6 deg). The common normal of two axes that far from parallel still moves by ten times their
// distance times a change of their angle at most; nearer, D&H is not used.
inline constexpr double kParallelSine = 0.1;
bool AreParallel(const Eigen::Vector3d& u, const Eigen::Vector3d& v);

// The same lines with the freedom of prismatic joints used: one whose next axis is parallel goes
// through that axis, and both have their point p where they meet, so that the link between them
// needs no length at nominal (Eq. 17).
std::vector<AxisLine> WithPrismaticPlaced(const Robot& robot, std::vector<AxisLine> lines);

}  // namespace truepose
