// Coordinates of the target that readings can't tell from motions of the base.
//
// Where all axes that turn are parallel (SCARA, gantry, a session that moves two parallel joints) a
// shift of the target along them is a shift of the base: any height of the target fits, and the
// best of many starts has any, by the order of the rows. That holds at nominal parameters only: at
// the tilts of the real robot the target is a lever, and one of a metre in place of a tenth biases
// lengths by many times their deviation. So such coordinates are set to what is known, the nominal
// tool, and the base moves along with them, which leaves the predictions at nominal as they are.
#pragma once

#include "core/identification/identifiability.h"

namespace truepose {

// Identifiable of base, tool and unknown constants alone, with the internal parameters at nominal:
// there the redundancies are exact. Bounds on deviations are not used.
IdentifiableSet FrameSet(const Problem& problem, const Estimate& estimate,
                         const ModelError& model_error, IdentifiabilityOptions options);

// Moves every target's dropped coordinates (FrameSet) to those of `X_FT_nominal` and the kept ones
// along their relations: exact for positions, to second order in steps of 0.1 rad for rotations,
// which least squares on the kept ones then makes up for. Coordinates that no reading shows, and
// relations with a candidate that is not in `free`, stay.
// @param free ascending candidates that may move; empty = all.
void SetFreeToolsToNominal(const Problem& problem, const Pose& X_FT_nominal,
                           const std::vector<int>& free, const IdentifiabilityOptions& options,
                           Estimate* estimate);

}  // namespace truepose
