// The poses of earlier sessions that identify a robot's parameters best, for a session of fewer.
#pragma once

#include <vector>

#include "absl/status/statusor.h"
#include "core/base/hooks.h"
#include "core/identification/weights.h"

namespace truepose {

struct ThinnedPoses {
  std::vector<int> indices;  // of the problem's readings, in an order to be measured in
  int parameters = 0;        // base, tool and internal ones that all the candidates determine
  double log_det = 0;        // of their whitened information, SI (d_optimal.h)
  double condition = 0;      // of the chosen rows' derivative, columns scaled to norm 1
};

// Chooses `count` of the problem's readings by D-optimality of the identification Jacobian of
// model, base and tool, whitened by stated noise and `model_error`; what was measured has no part
// in it. The order begins at the lowest index and goes on to the pose that is reached with the
// least travel of the joint that travels farthest (rad or m), ties to the lower index.
// @param problem readings to choose from, usually of one placement and target, as the new session
// will be. @param estimate frames and lambda as calibrated.
// @returns kInvalidArgument with faults, all at once: `poses` for a count that leaves no more
// measured values than parameters, or exceeds the candidates; `candidates` for none;
// kFailedPrecondition with the fault `poses` when no choice of so few determines all parameters;
// kCancelled.
absl::StatusOr<ThinnedPoses> ThinPoses(const Problem& problem, const Estimate& estimate,
                                       const ModelError& model_error, int count,
                                       const Hooks& hooks = {});

// Nearest neighbours, as above. @param q joints of each index.
std::vector<int> MeasuringOrder(std::vector<int> indices, const std::vector<Eigen::VectorXd>& q);

}  // namespace truepose
