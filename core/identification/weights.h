// Weights of the readings: the covariance R of each residual, and the estimate of s_model from the
// residuals.
//
//   R = [ D (S_stated + J_q S_q J_q') D' + diag(s_model^2) ] / weight
// S_stated: the stated uncertainty of the measured pose; J_q S_q J_q': the joints' noise carried
// through the joint Jacobian (pose matching, chapter-notes 19); D: residual by pose; weight: that
// of a robust loss. A tracker's stated scatter (0.03 mm) is not the model's error (0.5 mm on a real
// arm), so weights from the stated scatter alone are wrong. s_model has one value for position and
// one for rotation, each per axis.
#pragma once

#include "core/identification/problem.h"

namespace truepose {

struct ModelError {
  double position_sd_m = 1e-3;    // per axis
  double rotation_sd_rad = 1e-3;  // per axis
};

using ResidualMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 6, 6>;

// R of a reading at an estimate.
ResidualMatrix CovarianceOf(const Problem& problem, const Reading& reading,
                            const Estimate& estimate, const ModelError& model_error);

// How many directions of the residual the stated uncertainty and the joints' noise reach: the rank
// of R without s_model, its rows scaled to unit variance, directions below 1e-5 of a deviation not
// counted. Less than the rows where fewer joints than rows have noise, or at a singular pose.
int StatedRank(const Problem& problem, const Reading& reading, const Estimate& estimate);

// W with W R W' = I, so that W r has unit covariance; a weight of 0 gives W = 0.
ResidualMatrix WhitenerOf(const Problem& problem, const Reading& reading, const Estimate& estimate,
                          const ModelError& model_error);
// Of every reading. Held while a solver runs, as R moves with the estimate too slowly to matter.
using Whiteners = std::vector<ResidualMatrix>;
Whiteners WhitenersOf(const Problem& problem, const Estimate& estimate,
                      const ModelError& model_error);

// The stacked whitened system: residual rows and derivative by *all* candidates. Rows of the prior
// come last.
struct WhitenedSystem {
  Eigen::VectorXd r;       // whitened
  Eigen::VectorXd raw;     // m and rad; 0 for rows of the prior
  Eigen::VectorXd sd;      // of each raw row, square root of the diagonal of R times weight
  Eigen::VectorXd weight;  // of each row
  enum class Row { kPosition, kRotation, kPrior };
  std::vector<Row> kind;
  Eigen::MatrixXd J;  // rows x candidates, whitened
};

WhitenedSystem Whitened(const Problem& problem, const Estimate& estimate,
                        const ModelError& model_error);
WhitenedSystem Whitened(const Problem& problem, const Estimate& estimate,
                        const ModelError& model_error, const Whiteners& whiteners);

// Half the sum of squares of the whitened residuals, prior included.
double CostOf(const Problem& problem, const Estimate& estimate, const Whiteners& whiteners);

// Variance components: for each of position and rotation the s_model at which
//   sum r^2 / (s_stated^2 + s_model^2) = rows - trace of the group's part of the hat matrix,
// that is the redundancy left after `active` parameters took their share. Where the rows of a
// reading are correlated (joint noise, a covariance) the equations of restricted maximum likelihood
// take its place: r'R^-1 I_g R^-1 r = tr(R^-1 I_g) - tr(R^-1 I_g R^-1 J C J'),
// the parameters' share J C J' held as a share of the rows whitened by the current weights. Where
// the stated scatter alone already exceeds the residuals s_model is its floor (0.1 um, 1e-8 rad:
// below any instrument, it only keeps weights finite).
// @param active candidate indices, linearly independent at the estimate.
// Readings with weight w add (w r)^2 and count as w.
// @param consistency E[(w r)^2] / (E[w] s^2) of normal residuals under a robust loss; 1 without
// one.
ModelError EstimateModelError(const Problem& problem, const Estimate& estimate,
                              const std::vector<int>& active, const ModelError& current,
                              double consistency = 1);

}  // namespace truepose
