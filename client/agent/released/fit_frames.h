// Poses that a controller reports, beside those of a model of its arm.
//
// With W what the controller's poses are written in and T what stands there, it reports
//   X_WT = X_WB X_BF(q) X_FT
// with the X_BF of the parameters that it runs. W and T are settings of the controller that nobody
// need know: they are fitted, so that what is left depends on the parameters alone.
#pragma once

#include <span>

#include "core/geometry/pose.h"

namespace truepose::agent {

struct PosePair {
  Pose X_BF;  // by the model
  Pose X_WT;  // as reported
};

struct Frames {
  Pose X_WB, X_FT;
};

// Standard deviations of what is reported: its rounding, and joints that are not quite the ones
// said. Of each coordinate, m and rad.
struct PoseNoise {
  double position_m = 1e-5;
  double rotation_rad = 8.7e-5;  // 0.005 deg
};

struct FrameFit {
  Frames frames;
  // Of the residuals p_WT - p and Log(R_WT R^T), each over its standard deviation.
  double sum_of_squares = 0;
  int degrees_of_freedom = 0;  // 6 for each pair, less what the fit has determined
  double position_rms_m = 0, position_largest_m = 0;  // of the lengths
  double rotation_rms_rad = 0;
};

// Least sum of squares over X_WB and X_FT, by Gauss-Newton steps from the frames that relative
// rotations tell, and from those that positions tell; the better end counts. What the pairs don't
// determine stays where it began. @param pairs at least one
FrameFit FitFrames(std::span<const PosePair> pairs, const PoseNoise& noise);

// The same of frames that are known.
FrameFit ResidualsOf(std::span<const PosePair> pairs, const PoseNoise& noise, const Frames& frames);

}  // namespace truepose::agent
