// How far a place is from a singularity: the smallest singular value of the chain's Jacobian with
// lengths over a characteristic length, so that it does not depend on the unit or the robot's size.
// Of an arm with n < 6 joints it is that of the 6 x n Jacobian: whether all joints still move the
// flange differently.
#pragma once

#include "compensation/kinematics.h"

namespace truepose::compensation {

// Half of the sum of the distances between consecutive joint frames, m: about the arm's reach from
// its middle. 1 where all frames coincide.
double CharacteristicLength(const JointChain& chain) noexcept;

// Columns of prismatic joints are multiplied by `length_m`, rows of the displacement divided.
double SmallestSingularValue(const JointChain& chain, const Sweep& sweep, double length_m) noexcept;
// Of the nominal chain at controller joints q.
double SmallestSingularValue(const Arm& arm, const double* q, double length_m) noexcept;

}  // namespace truepose::compensation
