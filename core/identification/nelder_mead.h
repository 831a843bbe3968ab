// Nelder and Mead's simplex (the amoeba) with coefficients that fit the dimension n: reflection 1,
// expansion 1 + 2/n, contraction 3/4 - 1/(2n), shrinkage 1 - 1/n (Gao and Han). With the usual 2,
// 1/2, 1/2 it stalls from about ten dimensions on. Needs no derivatives; expects coordinates in
// which the function is about as steep in every direction.
#pragma once

#include <Eigen/Core>
#include <functional>

namespace truepose {

struct NelderMeadOptions {
  double step = 1;              // edge of the first simplex along each coordinate
  double value_tolerance = 0;   // ends when worst - best is at most this
  int max_evaluations = 5'000;  // of this run, never exceeded but by the first simplex, n + 1
};

struct NelderMeadResult {
  Eigen::VectorXd point;  // the best vertex, never worse than the start
  double value = 0;
  int evaluations = 0;
  bool converged = false;
};

// @param function a value that is not finite counts as worse than any other. @param start n >= 1.
// @param stop asked before every step; ends the run with the best vertex so far.
NelderMeadResult NelderMead(const std::function<double(const Eigen::VectorXd&)>& function,
                            const Eigen::VectorXd& start, const NelderMeadOptions& options,
                            const std::function<bool()>& stop);

}  // namespace truepose
