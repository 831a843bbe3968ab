// Table 3: the 28 parameters of the Stanford arm in the chapter's models, and which of them are
// external, found from the models and not from the table.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace truepose {

struct Table3Column {
  std::string model;               // as BuildModel names it
  std::vector<std::string> names;  // the identifiable ones, along the arm
  std::vector<std::string> base;   // those that move every pose as a motion of the base does
  std::vector<std::string> gripper;
  std::vector<std::string> redundant;  // "dh3 = +1 dh2"
  int internal = 0;                    // rank less that of base and gripper together
  // What the chapter prints, in our names (theta_i and h_i as errors dtheta_i, dh_i; q_i as dq_i).
  // Without zhuang_roth, which is not in the table: there it is empty.
  std::vector<std::string> printed_names, printed_base, printed_gripper;
};

// At random poses of the Stanford arm, its first axis d0 beside the base: with d0 = 0 Hayati's form
// of the base is singular. In full pose, so 4R + 2P + 6 = 28 parameters (Eq. 11).
absl::StatusOr<std::vector<Table3Column>> Table3();

}  // namespace truepose
