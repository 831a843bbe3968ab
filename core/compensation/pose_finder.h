// Joints at poses of a box, all in one configuration of the arm.
#pragma once

#include <optional>
#include <vector>

#include "compensation/arm.h"
#include "core/compensation/table_axes.h"
#include "core/compensation/table_spec.h"

namespace truepose {

// Position in B m, two components of the tilt rad, roll rad (BoxDomain). The poses of a box are
// convex in these, so straight lines between its places stay in it.
using Place = Eigen::Matrix<double, 6, 1>;

// X_BF of the places of a box.
class Places {
 public:
  Places(const compensation::Arm& arm, const BoxDomain& box);

  // Where the reference joints are; may lie outside the box.
  const Place& start() const { return start_; }
  Pose FlangeAt(const Place& place) const;

 private:
  Eigen::Matrix<double, 3, 2> across_;  // of the approach
  Pose X_TF_;
  Eigen::Matrix3d R_0_;
  Place start_;
};

// Solves the nominal chain by Newton along the straight line from the nearest place reached before,
// the first from the reference joints: so the configuration is kept, and a part of the box behind a
// singularity counts as not reached. An arm of fewer than six joints meets the position, and the
// direction of the tool's z axis as nearly as it can; roll has no part then.
class PoseFinder {
 public:
  PoseFinder(const compensation::Arm& arm, const BoxDomain& box);

  // Chain joints at the place; nothing where the way there fails or ends beyond the limits.
  std::optional<JointVector> Reach(const Place& place);

 private:
  struct Reached {
    Place place;
    JointVector q;
  };
  const Reached& NearestTo(const Place& place) const;
  void Keep(const Reached& nearest, const Reached& reached);
  std::optional<JointVector> Follow(const Reached& from, const Place& to) const;
  bool WithinLimits(const JointVector& q) const;

  const compensation::Arm& arm_;
  Places places_;
  Eigen::Vector3d axis_F_;  // the tool's z axis
  TableAxes chain_;
  std::vector<Reached> reached_;
};

}  // namespace truepose
