#include "core/calibrate/calibrate.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/calibrate/sets.h"

namespace truepose {
namespace {

// Turns the solver's iterations into a fraction that only grows: half of what is left every 20
// iterations.
class StagedHooks {
 public:
  explicit StagedHooks(const Hooks& hooks) : hooks_(hooks) {}

  Hooks For(const std::string& stage, double from, double to) {
    Hooks staged;
    staged.is_cancelled = hooks_.is_cancelled;
    auto count = std::make_shared<int>(0);
    staged.on_progress = [this, stage, from, to, count](const Progress& progress) {
      const double share = 1 - std::exp2(-++*count / 20.0);
      hooks_.Report({stage, from + (to - from) * share, progress.iteration, progress.cost});
    };
    hooks_.Report({stage, from, 0, 0});
    return staged;
  }

 private:
  const Hooks& hooks_;
};

absl::Status CheckProblem(const CalibrationProblem& problem) {
  FaultList faults;
  if (problem.readings.empty()) faults.Add("readings", "none that can be used", "at least one");
  if (problem.calibrates.size() != problem.readings.size()) {
    faults.Add("roles", absl::StrCat(problem.calibrates.size()),
               absl::StrCat(problem.readings.size(), ", one a reading"));
  } else if (std::count(problem.calibrates.begin(), problem.calibrates.end(), true) == 0) {
    faults.Add("readings", "no calibration row that can be used", "at least one");
  }
  return faults.ToStatus();
}

absl::Status CheckRedundancy(const Identification& identification) {
  const int unknowns = static_cast<int>(identification.set.active.size());
  if (identification.rows > unknowns) return absl::OkStatus();
  FaultList faults;
  faults.Add("readings",
             absl::StrCat(identification.rows, " measured values for ", unknowns, " parameters"),
             "more measured values than parameters: the weights come from what is left over");
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

absl::Status CheckComplete(const IdentifiableSet& set, const ParameterSet& candidates) {
  FaultList faults;
  for (const NullRelation& relation : set.redundancies) {
    if (relation.structural) continue;
    faults.Add(candidates[relation.dropped].name, ReasonText(relation, candidates),
               "readings that determine every parameter (require_complete)");
  }
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

SetResult SetOf(const CalibrationProblem& whole, const Model& model,
                const std::vector<bool>& chosen, const Estimate& before, const Estimate& after) {
  Problem problem = WholeProblem(whole, model);
  problem.readings.clear();
  for (size_t i = 0; i < whole.readings.size(); ++i) {
    if (chosen[i]) problem.readings.push_back(whole.readings[i]);
  }
  return {PoseErrors(problem, before), PoseErrors(problem, after)};
}

absl::Status Assess(const CalibrationProblem& problem, const Part& part, const Hooks& hooks,
                    CalibrationResult* result) {
  TRUEPOSE_ASSIGN_OR_RETURN(WholeFrames before,
                            FramesOfWhole(problem, result->model, part, result->before, hooks));
  TRUEPOSE_ASSIGN_OR_RETURN(WholeFrames after, FramesOfWhole(problem, result->model, part,
                                                             result->identification, hooks));
  result->before_frames = std::move(before.estimate);
  result->after_frames = std::move(after.estimate);
  result->base_fitted_on = std::move(after.base_fitted_on);
  result->tool_fitted_on = std::move(after.tool_fitted_on);
  std::vector<bool> controls = problem.calibrates;
  controls.flip();
  const std::vector<bool> all(problem.calibrates.size(), true);
  const Estimate &b = result->before_frames, &a = result->after_frames;
  result->calibration = SetOf(problem, result->model, problem.calibrates, b, a);
  result->control = SetOf(problem, result->model, controls, b, a);
  result->complete = SetOf(problem, result->model, all, b, a);
  result->verdict = Judge(result->identification, result->model.parameters, result->control.before,
                          result->control.after);
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<CalibrationResult> Calibrate(const CalibrationProblem& problem,
                                            const CalibrateOptions& options, const Hooks& hooks) {
  TRUEPOSE_RETURN_IF_ERROR(CheckProblem(problem));
  StagedHooks stages(hooks);
  CalibrationResult result;
  result.model = ModifiedIncremental(*problem.robot, ModelExtent::kInternal);
  const Part part = PartOf(problem, result.model, problem.calibrates);
  StartOptions start_options;
  start_options.X_FT = problem.X_FT_nominal;
  TRUEPOSE_ASSIGN_OR_RETURN(const Estimate start, FindStart(part.problem, start_options,
                                                            stages.For("start_values", 0, 0.1)));
  TRUEPOSE_ASSIGN_OR_RETURN(result.before, FitFrames(part.problem, start, options.identify,
                                                     stages.For("start_values", 0.1, 0.3)));
  const IdentifiableSet generic = GenericIdentifiable(part.problem, *problem.robot);
  TRUEPOSE_ASSIGN_OR_RETURN(result.identification,
                            Identify(part.problem, generic, result.before, options.identify,
                                     stages.For("identification", 0.3, 0.9)));
  result.candidates = Candidates(part.problem);
  TRUEPOSE_RETURN_IF_ERROR(CheckRedundancy(result.identification));
  if (options.require_complete) {
    TRUEPOSE_RETURN_IF_ERROR(CheckComplete(result.identification.set, result.candidates));
  }
  TRUEPOSE_RETURN_IF_ERROR(Assess(problem, part, stages.For("assessment", 0.9, 1), &result));
  hooks.Report({"assessment", 1, result.identification.summary.iterations,
                result.identification.summary.final_cost});
  return result;
}

absl::StatusOr<EvaluationResult> Evaluate(const CalibrationProblem& problem,
                                          const Eigen::VectorXd& lambda,
                                          const CalibrateOptions& options, const Hooks& hooks) {
  if (problem.readings.empty())
    return FaultStatus("readings", "none that can be used", "at least one");
  const Model model = ModifiedIncremental(*problem.robot, ModelExtent::kInternal);
  const Problem whole = WholeProblem(problem, model);
  StartOptions start_options;
  start_options.X_FT = problem.X_FT_nominal;
  TRUEPOSE_ASSIGN_OR_RETURN(const Estimate start, FindStart(whole, start_options, hooks));
  TRUEPOSE_ASSIGN_OR_RETURN(const Identification before,
                            FitFrames(whole, start, options.identify, hooks));
  TRUEPOSE_RETURN_IF_ERROR(
      CheckFrames(whole, GenericIdentifiable(whole, *problem.robot), before.set));
  TRUEPOSE_RETURN_IF_ERROR(CheckRedundancy(before));
  Estimate with_lambda = before.estimate;
  with_lambda.lambda = lambda;
  TRUEPOSE_ASSIGN_OR_RETURN(const Identification after,
                            FitFrames(whole, with_lambda, options.identify, hooks));
  return EvaluationResult{{PoseErrors(whole, before.estimate), PoseErrors(whole, after.estimate)},
                          before.estimate,
                          after.estimate};
}

}  // namespace truepose
