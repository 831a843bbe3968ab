// Prediction of one reading and its derivatives.
#pragma once

#include "core/identification/problem.h"

namespace truepose {

// rows x n, row-major as the solver wants it; at most 6 rows.
using RowJacobian =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, 6, Eigen::Dynamic>;

// Derivatives of the residual by the reading's own parameters.
struct ReadingJacobian {
  RowJacobian base;      // rows x 6
  RowJacobian tool;      // rows x 6
  RowJacobian offset;    // rows x 1, zero where the reading has none
  RowJacobian internal;  // rows x model parameters
};

// Reused from call to call, one per thread.
struct Workspace {
  ModelSweep sweep;
  Eigen::Matrix<double, 6, Eigen::Dynamic> twists;
};

// X_MT of a reading at an estimate.
Pose Predict(const Problem& problem, const Reading& reading, const Estimate& estimate);

// The parameters of one reading: corrections of its frames, its constant, the internal ones.
struct ReadingPoint {
  const Pose *X_MB, *X_FT;    // frames that the corrections are of
  const double *base, *tool;  // six corrections each
  double offset;              // m; ignored by readings without one
  const double* internal;
};

// Residual at a point.
// @param r in m and rad, not weighted. @param J nullptr, or d r / d parameters.
void EvaluateReading(const Model& model, const Reading& reading, const ReadingPoint& point,
                     Workspace* workspace, Residual* r, ReadingJacobian* J);

// The point of a reading at an estimate, corrections zero.
ReadingPoint PointOf(const Reading& reading, const Estimate& estimate);

// Residual of a reading at an estimate, corrections zero.
Residual ResidualAt(const Problem& problem, const Reading& reading, const Estimate& estimate);

// d r / d q of a reading at an estimate, q the chain joints as read; effects move too slowly with q
// to matter here. rows x joints.
RowJacobian JointJacobian(const Problem& problem, const Reading& reading, const Estimate& estimate,
                          Workspace* workspace);

}  // namespace truepose
