// The nominal chain with a table's correction in it.
#pragma once

#include "compensation/kinematics.h"
#include "compensation/lookup.h"

namespace truepose::compensation {

// (Exp(r), t) of a correction.
Pose PoseOfDelta(const Delta& delta) noexcept;

// The flange of the nominal chain with E before the motion of its last joint: X_BL E Z_n C[n].
Pose CorrectedFlange(const JointChain& chain, const Motions& motions, const Delta& delta) noexcept;

// Controller joints of a target to those of the nominal chain, and back.
void ChainJoints(const Table& table, const double* q_controller, double* q_chain) noexcept;
void ControllerJoints(const Table& table, const double* q_chain, double* q_controller) noexcept;

}  // namespace truepose::compensation
