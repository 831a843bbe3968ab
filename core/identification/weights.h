// Weights of the readings, 1 / (s_stated^2 + s_model^2), and the estimate of s_model from the
// residuals.
//
// A tracker's stated scatter (0.03 mm) is not the model's error (0.5 mm on a real arm), so weights
// from the stated scatter alone are wrong. s_model has one value for position and one for rotation,
// each per axis.
#pragma once

#include "core/identification/problem.h"

namespace truepose {

struct ModelError {
  double position_sd_m = 1e-3;    // per axis
  double rotation_sd_rad = 1e-3;  // per axis
};

// The standard deviations of a reading's residual rows: sqrt(stated^2 + model^2), m then rad.
Residual StandardDeviations(const Reading& reading, const ModelError& model_error);

// The stacked whitened system: residual rows and derivative by *all* candidates.
struct WhitenedSystem {
  Eigen::VectorXd r;           // not weighted
  Eigen::VectorXd sd;          // of each row
  std::vector<bool> rotation;  // whether the row is one of rotation
  Eigen::MatrixXd J;           // rows x candidates, divided by sd
};

WhitenedSystem Whitened(const Problem& problem, const Estimate& estimate,
                        const ModelError& model_error);

// Variance components: for each of position and rotation the s_model at which
//   sum r^2 / (s_stated^2 + s_model^2) = rows - trace of the group's part of the hat matrix,
// that is the redundancy left after `active` parameters took their share. Where the stated scatter
// alone already exceeds the residuals s_model is its floor (0.1 um, 1e-8 rad: below any instrument,
// it only keeps weights finite).
// @param active candidate indices, linearly independent at the estimate.
ModelError EstimateModelError(const Problem& problem, const Estimate& estimate,
                              const std::vector<int>& active, const ModelError& current);

}  // namespace truepose
