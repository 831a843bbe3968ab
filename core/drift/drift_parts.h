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

// The part's change into change_m and change_rad: of several frames that which moved most.
// @param frames changes of the part's candidates, six a frame; @param joints of all controller
// joints.
void SetChange(const DriftProblem& problem, const CandidatePart& candidate,
               const Eigen::VectorXd& frames, const Eigen::VectorXd& joints, DriftPart* part);

// Frames that may have moved legitimately, and unknown constants of distances: free in every fit.
Freedom LegitimateChanges(const DriftProblem& problem);

}  // namespace truepose
