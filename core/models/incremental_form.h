// What the three incremental models share: the nominal chain rewritten so that every joint moves
// about or along z, with places for the errors of its axis (B_i), of its coordinate (D_i) and of
// the gripper (C):
//   M = A_0 B_0 [D_1] A_1 B_1 [D_2] A_2 ... [D_n] A_n C
// B_i places z_i, the axis of *joint i+1*, and so that joint decides its size: two rotations, and
// two lengths only when it is revolute (chapter-notes 1). Every A_i begins with its joint motion
// (chapter-notes 2): a joint about another axis u is turned by the constant rotation that carries z
// to u, and back behind it. B_0 and C are there with ModelExtent::kComplete only. C is Eq. 22's in
// every model: R(x, dalpha_n) R(y, dbeta_n) R(z, dgamma_n) T(x, da_n) T(y, db_n) T(z, dc_n).
#pragma once

#include "core/models/model.h"

namespace truepose {

// The form of B_i.
enum class AxisErrors {
  kRotationsFirst,  // Eq. 22: R(x, dalpha_i) R(y, dbeta_i) [T(x, da_i) T(y, db_i)]
  kTilt,  // Eq. 23: [T(x, da_i) T(y, db_i)] and the rotation of Tilt(dthetax_i, dthetay_i)
};

struct IncrementalForm {
  AxisErrors axis_errors = AxisErrors::kRotationsFirst;
  bool joint_offsets = false;  // with D_i, Eq. 25
};

// Fills chain, parameters, tilts and joint map; kind and convention are the builder's.
Model BuildIncremental(const Robot& robot, ModelExtent extent, const IncrementalForm& form);

}  // namespace truepose
