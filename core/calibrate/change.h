// Partial recalibration: some parameters found anew, the others as an earlier calibration left
// them.
//
// The held parameters H are known with the stored covariance C_HH only, and an error of theirs
// moves the estimate of the active ones A by G = -(J_A' J_A)^-1 J_A' J_H. So
//   cov(A) = (J_A' J_A)^-1 + G C_HH G'
// and, if nothing has changed, the new values N of the named parameters differ from the stored ones
// by a normal of mean 0 and covariance
//   (J_A' J_A)^-1_NN + [-I G_N] C_stored [-I G_N]'
// which the chi-square test of the difference uses. Errors of A and H go together from then on,
//   cov(A, H) = G C_HH
// and what was not found anew stays as uncertain as it was: a result carries the covariance of all,
// or the next calibration that starts from it would take the held ones for exact, or for unknown.
//
// Whether the readings fit what is held: with W r the whitened residuals of n rows and a active
// parameters, and C_HH = L L',
//   min over x, z of |W r - W J_A x - W J_H L z|^2 + |z|^2
// is r' (R + J_H C_HH J_H')^-1 r after the fit of A and has the distribution of chi-square with
// n - a degrees of freedom when nothing else has changed.
#pragma once

#include <string>
#include <vector>

#include "core/identification/identify.h"
#include "core/identification/prior.h"

namespace truepose {

struct ChangeTest {
  std::vector<std::string> names;  // internal parameters that were found anew
  double chi_square = 0;
  int degrees_of_freedom = 0;
  double p_value = 1;
  bool real = false;  // p below 0.01
  // Candidates that are held and uncertain, ascending, and the covariance of the active ones (in
  // their order) followed by these.
  std::vector<int> held;
  Eigen::MatrixXd covariance;
};

// Of the readings with what is held.
struct HeldFit {
  double chi_square = 0;
  int degrees_of_freedom = 0;
  double p_value = 1;
};

// @param identification its covariance is widened by what is not known of the held parameters.
// @param stored_lambda, stored_covariance of the model's parameters (prior.h).
ChangeTest TestChange(const Problem& problem, const Eigen::VectorXd& stored_lambda,
                      const Eigen::MatrixXd& stored_covariance, Identification* identification);

// @param stored_covariance as above. Readings have the weights of the identification's loss, R its
// variance factor.
HeldFit TestHeldFit(const Problem& problem, const Eigen::MatrixXd& stored_covariance,
                    const Identification& identification);

}  // namespace truepose
