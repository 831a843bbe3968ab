// The parts of a robot and its surroundings that a change may be in, as far as a check can see
// them.
//
//   base or joint 1      a motion of B in M at each placement that is held; joint 1 turns about an
//                        axis of B and can't be told from it
//   tool or last joint   a motion of T in F of each target that is held
//   joint i              an offset of controller joint i, for every joint whose motion is not one
//   of
//                        base or tool alone, seen or not: the first and the last
#pragma once

#include "core/drift/drift_fit.h"

namespace truepose {

struct CandidatePart {
  enum class Kind { kBase, kTool, kJoint };
  Kind kind;
  std::string name;
  Freedom freedom;
};

std::vector<CandidatePart> PartsOf(const DriftProblem& problem);

// Frames that may have moved legitimately, and unknown constants of distances: free in every fit.
Freedom LegitimateChanges(const DriftProblem& problem);

}  // namespace truepose
