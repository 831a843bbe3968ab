// Prediction of one reading and its derivatives.
#pragma once

#include "core/chain/chain.h"
#include "core/identification/problem.h"

namespace truepose {

// rows x n, row-major as the solver wants it; at most 6 rows.
using RowJacobian =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, 6, Eigen::Dynamic>;

// Derivatives of the residual by the reading's own parameters.
struct ReadingJacobian {
  RowJacobian base;      // rows x 6
  RowJacobian tool;      // rows x 6
  RowJacobian internal;  // rows x model parameters
};

// Reused from call to call, one per thread.
struct Workspace {
  Sweep sweep;
  Eigen::Matrix<double, 6, Eigen::Dynamic> twists;
};

// X_MT of a reading at an estimate.
Pose Predict(const Problem& problem, const Reading& reading, const Estimate& estimate);

// Residual at base corrections, tool corrections and internal parameters.
// @param X_MB, X_FT the frames that the corrections are of.
// @param base, tool six corrections each; internal model parameters.
// @param r in m and rad, not weighted. @param J nullptr, or d r / d parameters.
void EvaluateReading(const Model& model, const Reading& reading, const Pose& X_MB, const Pose& X_FT,
                     const double* base, const double* tool, const double* internal,
                     Workspace* workspace, Residual* r, ReadingJacobian* J);

// Residual of a reading at an estimate, corrections zero.
Residual ResidualAt(const Problem& problem, const Reading& reading, const Estimate& estimate);

}  // namespace truepose
