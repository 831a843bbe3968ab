// Joints at seeded poses of a box.
#pragma once

#include <cstdint>
#include <vector>

#include "compensation/arm.h"
#include "core/compensation/table_axes.h"
#include "core/compensation/table_spec.h"

namespace truepose {

struct PoseSamples {
  std::vector<JointVector> q_chain;  // of the poses that were reached (pose_finder.h)
  int unreachable = 0;
};

// Draws (position in the box, tilt within the cone, roll). @param on_rim share of positions put on
// the box's faces, and of tilts put on the cone's rim; 0: uniform in the box.
PoseSamples SamplePoses(const compensation::Arm& arm, const BoxDomain& box, int poses,
                        double on_rim, uint64_t seed);

}  // namespace truepose
