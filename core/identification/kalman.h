// The chapter's Kalman filter: parameters as a constant state, a reading at a time.
//
// State x: values of the active candidates (candidate_values.h). Measurement of reading h:
//   0 = r_h(x) + noise,  noise covariance R_h = (W_h'W_h)^-1,  C_h = -dr_h/dx (chapter-notes 19)
// linearised at the current estimate, or at a fixed one (LineariseAt). Prior: x at the start with
// covariance P_0, and the problem's own prior as further information.
//
// The filter is kept as a square root of the information, T x = z with T'T = P^-1, T upper
// triangular, and a reading is taken in by rotating its whitened rows into the triangle:
//   [T z; W C  W (r + C x_lin)] -> [T+ z+; 0 *]
// which is the filter's update in exact arithmetic. P - K C P loses symmetry and then positive
// definiteness when a precise reading follows a vague prior (P_0 of 3 mm, readings of 0.05 mm: P
// falls by thousands at once); Joseph's form keeps P positive, but works at the condition of P, the
// square of that of T. Here P = T^-1 T^-T, whatever is taken in.
#pragma once

#include <optional>

#include "core/identification/solve.h"
#include "core/identification/weighted_problem.h"

namespace truepose {

class KalmanFilter {
 public:
  // Keeps references to `problem` and its model. @param active candidate indices, n of them.
  // @param start where the state begins. @param P_0 n x n, positive definite, SI.
  KalmanFilter(const Problem& problem, const std::vector<int>& active, const Estimate& start,
               const Eigen::MatrixXd& P_0);

  // From here on readings are linearised at these values of the active candidates, and no longer
  // at the current estimate.
  void LineariseAt(const Eigen::VectorXd& x);
  // Takes a reading in. @param reading with placement, target and offset of the problem.
  // @param whitener W with R = (W'W)^-1; 0 takes nothing in.
  void Update(const Reading& reading, const ResidualMatrix& whitener);

  const Eigen::VectorXd& state() const { return x_; }  // of the active candidates, in their order
  Estimate estimate() const;
  Eigen::MatrixXd covariance() const;  // of the active candidates, in their order; SI

 private:
  Eigen::VectorXd Values(const Eigen::VectorXd& x) const;
  void Absorb(Eigen::MatrixXd rows);
  void SolveState();

  const Problem& problem_;
  const std::vector<int> active_;
  const Estimate start_;
  const Eigen::VectorXd start_values_;
  std::optional<Eigen::VectorXd> x_linear_;
  Eigen::MatrixXd triangle_;  // n x (n + 1): T, z
  Eigen::VectorXd x_;
  Workspace workspace_;
};

// P_0 of the options: diagonal, by role and unit of each active candidate.
Eigen::MatrixXd InitialCovariance(const Problem& problem, const std::vector<int>& active,
                                  const KalmanOptions& options);

// Solve() by the filter, whatever the options' estimator; of the options only `kalman` counts. The
// readings are taken in their order. A further pass begins again from the start and P_0, linearised
// at the end of the one before: no reading counts twice, and the covariance stays honest. (Passes
// that keep P shrink it by the root of their number.)
//
// How far one pass gets depends on how tight the first readings are against what the linear model
// is off there: with places known to 0.015 mm it ends within 1 % of the minimum, with exact places
// it may end at thrice the weighted RMS. Two passes end within 0.1 %. Their covariance is that of
// the minimum to a few 0.1 %, but where readings know a direction no better than P_0 (UR10 series
// D) deviations are still off by 13 %, with a third pass by 0.3 %.
//
// It ends
//   converged        when the cost at the end is within 0.2 % (its root within 0.1 %) of what the
//                    linear problem there still promises;
//   iteration_limit  when it is not: more passes are needed, or P_0 is too narrow;
//   failed           when an estimate is not finite, or the cost ends above 10 times that of the
//                    start. The estimate is left as it was.
// The summary has the filter's covariance, which is marked approximate after a single pass: its
// C_h were taken at estimates of little use.
SolveSummary FilterKalman(const Problem& problem, const ModelError& model_error,
                          const std::vector<int>& active, const SolveOptions& options,
                          const Hooks& hooks, Estimate* estimate);

}  // namespace truepose
