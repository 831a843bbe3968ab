// Parts of a calibration problem, with their placements and targets numbered anew.
#pragma once

#include <vector>

#include "core/calibrate/calibrate.h"

namespace truepose {

// A problem of some of the readings, and which frames of the whole its frames are.
struct Part {
  Problem problem;
  std::vector<int> placements, targets, offsets;  // part index -> whole index
};

// @param chosen one flag a reading.
Part PartOf(const CalibrationProblem& whole, const Model& model, const std::vector<bool>& chosen);

// All readings with the frames of the whole.
Problem WholeProblem(const CalibrationProblem& whole, const Model& model);

// Frames of the whole from those of the part; frames that the part does not have are fitted on
// their own rows with lambda and the known frames held.
struct WholeFrames {
  Estimate estimate;
  std::vector<FittedOn> base_fitted_on, tool_fitted_on;
};
absl::StatusOr<WholeFrames> FramesOfWhole(const CalibrationProblem& whole, const Model& model,
                                          const Part& part, const Identification& of_part,
                                          const Hooks& hooks);

}  // namespace truepose
