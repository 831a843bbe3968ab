// The simulated measuring robot of one seed and what operators read with it: the chapter's own
// readings were never published.
#pragma once

#include <numbers>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/random.h"
#include "core/reproduce/dime.h"
#include "core/reproduce/measuring_robot.h"

namespace truepose {

// Standard deviations of the drawn errors, and the mean position error over the dime at nominal
// parameters that the 14 of Eq. 38 are scaled to give: the chapter's 4.702 mm (Table 4).
struct DimeTruth {
  double main_length_sd_m = 1.5e-3;  // of Eq. 38's 14
  double main_angle_sd_rad = 0.4 * std::numbers::pi / 180;
  double other_length_sd_m = 0.35e-3;  // of the other 11
  double other_angle_sd_rad = 0.12 * std::numbers::pi / 180;
  double mean_error_m = 4.702e-3;
};

// @returns the true parameters. kFailedPrecondition when a hole is out of the true robot's reach.
absl::StatusOr<Eigen::VectorXd> DrawTruth(const Model& measuring_robot, const DimeTruth& truth,
                                          Random* random);

// How an operator puts the pin into a hole, and how the joints are then read.
struct DimeNoise {
  double position_sd_m = 15e-6;  // of the hand, per axis
  double tilt_rms_rad = 8e-5;    // of the hand: how far the pin leans, whichever way
  double resolution_rad = 0.018 * std::numbers::pi / 180;  // of the encoders, Sec. 11.2
};

// One reading for each pose of the dime, by pose matching as in Fig. 3: the hole's place and
// direction are the measured ones, its id the pose's index. The hand's noise is stated as the
// measurement's, the rounding as joint_sd.
absl::StatusOr<std::vector<Reading>> ReadDime(const Model& measuring_robot,
                                              const Eigen::VectorXd& truth, const DimeNoise& noise,
                                              Random* random);

}  // namespace truepose
