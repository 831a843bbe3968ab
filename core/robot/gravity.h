// What gravity does to the joints of a robot whose masses are known. Up is the z axis of B.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/chain/chain.h"

namespace truepose {

// A mass that moves with chain joint `joint` (counted from 0); its centre in B with all chain
// joints at zero, m.
struct LinkMass {
  int joint = 0;
  double mass_kg = 0;
  Eigen::Vector3d centre_B = Eigen::Vector3d::Zero();
};

// Load of every chain joint: -dU/dq_j with U = sum m g z, N m of a revolute joint, N of a prismatic
// one. @param chain nominal, from B; @param q chain joints.
Eigen::VectorXd GravityLoad(const Chain& chain, const std::vector<LinkMass>& masses,
                            const Eigen::VectorXd& q);

}  // namespace truepose
