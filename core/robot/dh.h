// Denavit-Hartenberg tables as elementary chains. Lengths in m, angles in rad.
#pragma once

#include <vector>

#include "core/chain/chain.h"
#include "core/robot/robot.h"

namespace truepose {

struct DhRow {
  double theta = 0, d = 0, a = 0, alpha = 0;
};

// A_i = R(z, theta_i) T(z, d_i) T(x, a_i) R(x, alpha_i), Eq. 15; joint i moves theta_i (revolute)
// or d_i (prismatic).
// @param types one per row. The chain has four elements a row.
Chain ChainFromStandardDh(const std::vector<DhRow>& rows, const std::vector<JointType>& types);

// Craig: R(x, alpha_{i-1}) T(x, a_{i-1}) R(z, theta_i) T(z, d_i).
Chain ChainFromCraigDh(const std::vector<DhRow>& rows, const std::vector<JointType>& types);

}  // namespace truepose
