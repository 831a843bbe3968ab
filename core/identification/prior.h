// What was known of the internal parameters before the readings.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/identification/weights.h"

namespace truepose {

// Tolerances of manufacture: normal about nominal. For sessions too small to determine everything.
struct TolerancePrior {
  double length_sd_m = 3e-4;
  double angle_sd_rad = 5.2359877559829887e-4;  // 0.03 deg
};

// Diagonal; effects get none, since no drawing states them.
Prior PriorOf(const TolerancePrior& tolerance, const ParameterSet& parameters);

// Joint effects about zero, normal: harmonics 0.03 deg, gain 0.0005. Along joint ranges that few
// readings visit, gain, harmonics and offset make up for each other and run away without it (a UR10
// from 800 poses: 0.490 -> 0.535 mm). Compliance and temperature have none: their size is unknown.
// Effects that the prior holds already get nothing: an earlier calibration's covariance contains
// it.
void AddEffectPrior(const ParameterSet& parameters, Prior* prior);

// A prior that says nothing.
Prior NoPrior(const ParameterSet& parameters);

// A calibration made before, as it was stored.
struct StoredCalibration {
  std::string convention;                                // of its model; "" where it is not known
  std::vector<std::pair<std::string, double>> internal;  // all its internal parameters, SI
  std::vector<std::string> identified;                   // beside the covariance
  Eigen::MatrixXd covariance;                            // of `identified`, SI
  ModelError model_error;
};

// Its parameters in the order of a model; those that it does not have are 0.
// @returns kInvalidArgument with a fault for each name that the model does not have.
absl::StatusOr<Eigen::VectorXd> LambdaOf(const StoredCalibration& stored,
                                         const ParameterSet& parameters);

// The covariance of the stored internal parameters, model parameters x model parameters, zero for
// those that were not identified.
Eigen::MatrixXd InternalCovariance(const StoredCalibration& stored, const ParameterSet& parameters);

// @returns kInvalidArgument with faults when the covariance is not square of the size of
// `identified`, not finite, not symmetric or not positive definite; or for unknown names.
absl::StatusOr<Prior> PriorOf(const StoredCalibration& stored, const ParameterSet& parameters);

}  // namespace truepose
