// The covariance S of all check readings together: stated noise of each, and the calibration's
// unexplained residual as a field over joint space.
//
// What a model can't explain is the same again at the same pose, and nearly so beside it: between
// readings at joint distance d (Euclidean, rad and m alike) of the same kind, placement and target
// it has the correlation
//   rho(d) = (1 - d / 0.6)^(n/2 + 1) for d < 0.6, else 0       (Wendland; positive definite in n
//   joints)
// row by row. On the measured UR10 of series C the residuals of control rows correlate with 0.85
// below 0.05 rad, 0.31 from 0.1 to 0.2, 0.11 from 0.2 to 0.3, 0.04 from 0.3 to 0.5 and not beyond;
// this rho gives 0.84, 0.32, 0.12, 0.01. Ten readings of one pose then count as little more than
// one, where readings taken for independent would raise an alarm.
#pragma once

#include <Eigen/Sparse>

#include "core/identification/weights.h"

namespace truepose {

// rho at joint distance d of a robot with n joints.
double FieldCorrelation(double d, int n);

class FieldWhitener {
 public:
  FieldWhitener(const Problem& problem, const Estimate& estimate, const ModelError& model_error);

  // W rows with W S W' = I; row i of the result belongs to the reading of row i.
  Eigen::MatrixXd Apply(const Eigen::MatrixXd& rows) const;

 private:
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> factor_;
};

}  // namespace truepose
