// How far the tool is predicted to be off, and whether control readings agree.
//
// At a reading the position error of a calibrated robot is predicted to have the covariance
//   S = J C J' + R
// J: position residual by the identified parameters, C: their covariance, R: stated uncertainty and
// unexplained residual s_model (weights.h). J C J' alone is what the parameters leave uncertain: it
// shrinks with every reading and says nothing of what the model can't explain.
#pragma once

#include <vector>

#include "core/identification/identify.h"

namespace truepose {

struct PredictedAccuracy {
  int control = 0;                  // readings judged: those with position rows
  int inside = 0;                   // r' S^-1 r below the 95 % quantile of chi-square
  int inside_covariance_alone = 0;  // the same with S = J C J'
  double position_rms_m = 0;        // root of the mean trace of S
};

// @param problem its frames are those of `identification`; its readings are those to judge.
PredictedAccuracy Predicted(const Problem& problem, const Identification& identification);

// Root mean square of sqrt(trace(J C J')) over the readings, position in m: what the parameters
// alone leave uncertain there.
double ParameterUncertainty(const Problem& problem, const Identification& identification);

// Identified parameters that the readings hardly tell apart: |correlation| above `above`.
struct Correlation {
  int a, b;  // candidates, a < b
  double value;
};
std::vector<Correlation> Correlations(const Identification& identification, double above = 0.8);

}  // namespace truepose
