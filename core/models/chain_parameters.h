// The parameters of a model's chain, for those who fold values into it.
#pragma once

#include <Eigen/Core>

#include "core/models/model.h"

namespace truepose {

// Values of model.chain's parameters: lambda's geometric ones, with the angles of tilts in their
// places. @param lambda the model's parameters.
Eigen::VectorXd ChainParametersOf(const Model& model, const Eigen::VectorXd& lambda);

}  // namespace truepose
