// What a table holds at a node: how far an arm's flange is off, as a twist that stays small where
// corrections of joints do not.
#pragma once

#include <Eigen/Core>

#include "compensation/arm.h"
#include "compensation/kinematics.h"

namespace truepose {

using compensation::Twist;  // (t m, r rad)

// delta(q) of compensation/table.h: E = (Exp(r), t) with X_identified X_nominal^-1 = X_BL E
// X_BL^-1, L standing on the last joint's axis before its motion. @param q controller joints.
Twist CorrectionTwist(const compensation::Arm& arm, const double* q);

// The flange's origin in L, nominal. @param q_last_chain the last chain joint.
Eigen::Vector3d FlangeInL(const compensation::Arm& arm, double q_last_chain);

// (displacement of the flange's origin, r), small: what `twist` does to a flange at p_LF.
inline Twist FlangeMotion(const Twist& twist, const Eigen::Vector3d& p_LF) {
  Twist motion = twist;
  motion.head<3>() += twist.tail<3>().cross(p_LF);
  return motion;
}

}  // namespace truepose
