// Values of the candidates about a start, and the estimate that they mean.
//
// In the order of the candidates: six corrections of each of the start's frames, X(d) of
// measurement/frame.h, zero at the start; the unknown constants; the internal parameters. Every
// estimator moves in these coordinates and holds what is not active at its value at the start, so
// that all of them search the same set of estimates. Moving a frame step by step instead would turn
// it about axes that are held (turns do not commute), and a nested model would not be nested.
#pragma once

#include "core/identification/prediction.h"

namespace truepose {

// @returns all candidates at the start.
Eigen::VectorXd ValuesOf(const Problem& problem, const Estimate& start);

// The estimate that `values`, one of each candidate, mean about the start.
Estimate EstimateAt(const Problem& problem, const Estimate& start, const Eigen::VectorXd& values);

// The same of one reading; points into `start` and `values`.
ReadingPoint PointAt(const Problem& problem, const Reading& reading, const Estimate& start,
                     const Eigen::VectorXd& values);

}  // namespace truepose
