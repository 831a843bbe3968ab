// How small changes of a calibration change the one it was converted to.
//
// Both give the same prediction, X_MT'(q, y) = X_MT(q, x) for all q, and so do their neighbours:
//   J'(q) dy = J(q) dx   for all q,   hence   dy = T dx,  T = argmin |J' T - J|
// over poses spread over the joint ranges (the implicit function theorem: no step to choose, exact
// to rounding). The candidates of `to` that take part are those that the conversion solved for,
// with base and tool; effects and constants of distances keep their changes. A covariance C of x
// becomes T C T', with which every prediction has the covariance that it had.
#pragma once

#include "core/conversion/convert_calibration.h"

namespace truepose {

// One side of a conversion.
// @param problem placements, targets, offsets and the model; readings take no part.
struct ConversionSide {
  const Problem& problem;
  const Estimate& estimate;
};

// @param solved Conversion::solved.
// @returns T, candidates of `to` x candidates of `from`, SI.
Eigen::MatrixXd ConversionJacobian(const Robot& robot, const ConversionSide& from,
                                   const ConversionSide& to, const std::vector<int>& solved);

}  // namespace truepose
