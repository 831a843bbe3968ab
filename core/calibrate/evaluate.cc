#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/calibrate/calibrate.h"
#include "core/calibrate/checks.h"
#include "core/calibrate/sets.h"

namespace truepose {

absl::StatusOr<EvaluationResult> Evaluate(const CalibrationProblem& problem, const Model& model,
                                          const Eigen::VectorXd& lambda,
                                          const CalibrateOptions& options, const Hooks& hooks) {
  if (problem.readings.empty())
    return FaultStatus("readings", "none that can be used", "at least one");
  const Problem whole = WholeProblem(problem, model);
  StartOptions start_options;
  start_options.X_FT = problem.X_FT_nominal;
  IdentifyOptions identify = options.identify;
  identify.X_FT_nominal = problem.X_FT_nominal.value_or(Pose{});
  TRUEPOSE_ASSIGN_OR_RETURN(const Estimate start, FindStart(whole, start_options, hooks));
  TRUEPOSE_ASSIGN_OR_RETURN(const Identification before, FitFrames(whole, start, identify, hooks));
  TRUEPOSE_RETURN_IF_ERROR(
      CheckFrames(whole, GenericIdentifiable(whole, *problem.robot), before.set));
  TRUEPOSE_RETURN_IF_ERROR(CheckRedundancy(before));
  Estimate with_lambda = before.estimate;
  with_lambda.lambda = lambda;
  TRUEPOSE_ASSIGN_OR_RETURN(const Identification after,
                            FitFrames(whole, with_lambda, identify, hooks));
  return EvaluationResult{{PoseErrors(whole, before.estimate), PoseErrors(whole, after.estimate)},
                          before.estimate,
                          after.estimate};
}

}  // namespace truepose
