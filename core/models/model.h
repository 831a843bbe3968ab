// A model of a robot's geometric errors: a chain with parameters, and their names. Frozen once
// built.
#pragma once

#include <string>

#include "core/chain/chain.h"
#include "core/parameters/parameter_set.h"
#include "core/robot/robot.h"

namespace truepose {

// Which of the chapter's error frames a model has beside the internal ones.
enum class ModelExtent {
  kInternal,  // from B to F; base and tool are frames of the measurement (identification/problem.h)
  kComplete,  // with B_0 before joint 1 and C after joint n, as in Table 3
};

struct Model {
  std::string kind;  // "modified_incremental"
  std::string
      convention;  // tag that gives the parameter values their meaning; stored with every set
  Chain chain;     // parameters index `parameters`
  ParameterSet parameters;  // all candidates; which are identifiable depends on the readings
};

// The modified incremental model (Eq. 24) of any chain of R and P joints, all candidates:
//   M = A_0 B_0 D_1 A_1 B_1 D_2 A_2 ... D_n A_n C
// D_i = R(z, dq_i) or T(z, dq_i) (Eq. 25); B_i = R(x, dalpha_i) R(y, dbeta_i) [T(x, da_i) T(y,
// db_i)], the lengths only when *joint i+1*, whose axis B_i places, is revolute (Eq. 22 with
// chapter-notes 1); C = R(x) R(y) R(z) T(x) T(y) T(z). The nominal is rewritten first so that every
// A_i begins with its joint motion about or along z_{i-1} (chapter-notes 2): a joint about another
// axis u is turned by the constant rotation that carries z to u, and back behind it. The chain's
// joints are chain joints (after the joint map). Redundant candidates are not removed here: which
// partner of a redundancy stays is decided by Identifiable(), for generic or for actual poses.
Model ModifiedIncremental(const Robot& robot, ModelExtent extent);

}  // namespace truepose
