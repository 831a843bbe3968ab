// Why a model can't express a calibration of another one, for people.
#pragma once

#include <string>
#include <vector>

#include "absl/status/status.h"
#include "core/conversion/convert_calibration.h"

namespace truepose {

// A problem in the parameters of `to` whose readings are poses of `from`, as solved.
struct ConversionProblem {
  const Robot& robot;
  const Model& from;
  const Eigen::VectorXd& lambda;  // of `from`
  const Problem& problem;         // of `to`
  const std::vector<int>& active;
  const Estimate& start;  // nominal
  const Estimate& solved;
  PredictionGap worst;
};

// The largest size of a parameter, in m or rad, effects aside.
double LargestValue(const Model& model, const Eigen::VectorXd& lambda);

// kFailedPrecondition with one fault. The link is that of the parameter of `from` whose effect has
// the largest part outside of the span of `to`; where all are in it, the first whose parameter of
// `to` is within a factor of two of the largest.
absl::Status SingularLink(const ConversionProblem& conversion);

}  // namespace truepose
