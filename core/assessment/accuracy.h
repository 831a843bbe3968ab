// How far the tool is predicted to be off, and whether control readings agree.
//
// At a reading the position error of a calibrated robot is predicted to have the covariance
//   S = J C J' + R
// J: position residual by the identified parameters, C: their covariance, R: stated uncertainty and
// unexplained residual s_model (weights.h), times the variance factor wherever C has it. J C J'
// alone is what the parameters leave uncertain: it shrinks with every reading and says nothing of
// what the model can't explain.
//
// The 95 % region is r' S^-1 r <= k. What a model can't explain is not normal, its tails are
// longer: so k is the 95 % quantile of r' (R - J C J')^-1 r over the n calibration readings
// themselves (their residuals have that covariance), drawn towards the quantile of chi-square as if
// 100 normal readings had been seen beside them, since a quantile of few readings is a matter of
// luck.
#pragma once

#include <vector>

#include "core/identification/identify.h"

namespace truepose {

struct PredictedAccuracy {
  int control = 0;                  // readings judged: those with position rows
  int inside = 0;                   // of them inside their region
  int inside_covariance_alone = 0;  // the same with S = J C J'
  double position_rms_m = 0;        // root of the mean trace of S
};

// @param control its frames are those of `identification`; readings to judge.
// @param calibration the readings that `identification` was made from.
PredictedAccuracy Predicted(const Problem& control, const Problem& calibration,
                            const Identification& identification);

// What the internal parameters alone leave uncertain at the readings' joints, up to a motion of
// base and target: root mean square of the position of the readings' targets in m, base and target
// fitted again. 0 for no reading.
// @param problem frames as those of `identification`.
double ParameterUncertainty(const Problem& problem, const Identification& identification);

// Identified parameters that the readings hardly tell apart: |correlation| above `above`.
struct Correlation {
  int a, b;  // candidates, a < b
  double value;
};
std::vector<Correlation> Correlations(const Identification& identification, double above = 0.8);

}  // namespace truepose
