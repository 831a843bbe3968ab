// The problem that every estimator solves, as a function of its active candidates:
//
//   cost(x) = 1/2 sum_h |W_h r_h(x)|^2 + 1/2 |root (mean - lambda(x))|^2
//
// x: values of the active candidates (candidate_values.h), the others held at the start. W_h: the
// whiteners at the start. r_h: residuals in m and rad (measurement/reading.h); rows of the prior
// come last.
#pragma once

#include "core/identification/candidate_values.h"
#include "core/identification/weights.h"

namespace truepose {

class WeightedProblem {
 public:
  // @param active candidate indices. Keeps references to `problem`, `active` and `start`.
  WeightedProblem(const Problem& problem, const ModelError& model_error,
                  const std::vector<int>& active, const Estimate& start);

  int size() const { return static_cast<int>(active_.size()); }
  const Problem& problem() const { return problem_; }
  const Whiteners& whiteners() const { return whiteners_; }
  Eigen::VectorXd Start() const;  // x at the start
  Estimate At(const Eigen::VectorXd& x) const;
  double Cost(const Eigen::VectorXd& x) const;
  // Mean of the Euclidean norms of the position residuals in m, the chapter's E_op; readings
  // without position rows and the prior have no part in it.
  double MeanPositionError(const Eigen::VectorXd& x) const;
  // Whitened residual, and its derivative by x.
  void Linearise(const Eigen::VectorXd& x, Eigen::VectorXd* r, Eigen::MatrixXd* J) const;
  // Derivative by x of the position residuals in m, all readings stacked.
  Eigen::MatrixXd PositionJacobian(const Eigen::VectorXd& x) const;

 private:
  Eigen::VectorXd Values(const Eigen::VectorXd& x) const;

  const Problem& problem_;
  const std::vector<int>& active_;
  const Estimate& start_;
  const Eigen::VectorXd start_values_;
  const Whiteners whiteners_;
};

// Whitened residual of one reading and its derivative by the active candidates, rows x active.
// @param values of all candidates about the start.
void LineariseReading(const Problem& problem, const Reading& reading, const ResidualMatrix& W,
                      const std::vector<int>& active, const Estimate& start,
                      const Eigen::VectorXd& values, Workspace* workspace, Residual* r,
                      RowJacobian* J);
// The prior's rows; none without one.
void LinearisePrior(const Problem& problem, const std::vector<int>& active,
                    const Eigen::VectorXd& values, Eigen::VectorXd* r, Eigen::MatrixXd* J);

// 1 / norm of each column, which brings mixed units together; 0 for a column that is zero but for
// rounding, as it would look independent once scaled.
Eigen::VectorXd ColumnScale(const Eigen::MatrixXd& J);

// The step to the minimum of |r + J x|, by QR with column pivoting of J with columns scaled to norm
// 1.
struct LinearStep {
  Eigen::VectorXd x;
  double decrease = 0;     // of |r|^2 / 2 that the linear problem promises
  bool determined = true;  // false: J has not full column rank
};
LinearStep SolveLinear(const Eigen::VectorXd& r, const Eigen::MatrixXd& J);

}  // namespace truepose
