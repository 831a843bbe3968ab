// Joint effects: what a controller joint moves beside its reading (arm.h), and back.
#pragma once

#include "compensation/arm.h"

namespace truepose::compensation {

// Whether any effect of the arm is not zero.
bool HasEffects(const Arm& arm) noexcept;

// Loads by gravity of the controller's joints, N m or N: joint_scale^T times the loads -dU/dq of
// the nominal chain's joints, U = sum m g z.
void GravityLoads(const Arm& arm, const double* q_controller, double* load) noexcept;

// moved = q + effects(q), controller joints.
void MovedJoints(const Arm& arm, const double* q_controller, double* moved) noexcept;

// The readings at which the joints have moved to `moved`, by q <- moved - effects(q): effects are
// small (1e-2 at most), so each pass brings two digits or more. @returns false, with the last
// iterate in q_controller, when 50 passes do not settle: effects that are no small correction.
bool ReadingsOf(const Arm& arm, const double* moved, double* q_controller) noexcept;

}  // namespace truepose::compensation
