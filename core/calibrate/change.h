// Partial recalibration: some parameters found anew, the others as an earlier calibration left
// them.
//
// The held parameters H are known with the stored covariance C_HH only, and an error of theirs
// moves the estimate of the active ones A by G = -(J_A' J_A)^-1 J_A' J_H. So
//   cov(A) = (J_A' J_A)^-1 + G C_HH G'
// and, if nothing has changed, the new values N of the named parameters differ from the stored ones
// by a normal of mean 0 and covariance
//   (J_A' J_A)^-1_NN + [-I G_N] C_stored [-I G_N]'
// which the chi-square test of the difference uses.
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
};

// @param identification its covariance is widened by what is not known of the held parameters.
// @param stored_lambda, stored_covariance of the model's parameters (prior.h).
ChangeTest TestChange(const Problem& problem, const Eigen::VectorXd& stored_lambda,
                      const Eigen::MatrixXd& stored_covariance, Identification* identification);

}  // namespace truepose
