#include "core/calibrate/calibrate.h"

#include <algorithm>

#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/calibrate/assess.h"
#include "core/calibrate/checks.h"
#include "core/calibrate/gauge.h"
#include "core/calibrate/joint_sources.h"
#include "core/calibrate/parameter_choice.h"
#include "core/calibrate/run.h"

namespace truepose {
namespace {

// What a robust loss took from readings it takes from every choice and test that follows.
void KeepWeights(const std::vector<double>& weights, Problem* problem) {
  for (size_t i = 0; i < problem->readings.size(); ++i) problem->readings[i].weight = weights[i];
}

absl::Status IdentifyParameters(CalibrationRun* run, double from, double to,
                                CalibrationResult* result) {
  Problem& part = run->part.problem;
  const IdentifiableSet generic = GenericIdentifiable(part, *run->problem.robot);
  result->generic_rank = static_cast<int>(generic.active.size());
  result->counts = CountParameters(*run->problem.robot, part, generic);
  TRUEPOSE_ASSIGN_OR_RETURN(result->identification,
                            Identify(part, generic, result->before, run->identify,
                                     run->stages.For("identification", from, to)));
  KeepWeights(result->identification.weights, &part);
  result->candidates = Candidates(part);
  return CheckRedundancy(result->identification);
}

// Chooses among the geometric parameters and identifies those alone.
absl::Status SelectParameters(CalibrationRun* run, CalibrationResult* result) {
  if (!run->options.select) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(
      SelectionResult selected,
      ChooseParameters(run->part.problem, result->identification, result->before.estimate,
                       *run->options.select, run->stages.For("selection", 0.5, 0.6)));
  result->selection = std::move(selected.path);
  run->identify.free = std::move(selected.active);
  return IdentifyParameters(run, 0.6, 0.7, result);
}

// With a selection, the effects are free beside what was selected.
void FreeEffects(const Model& model, const Problem& part, std::vector<int>* free) {
  if (free->empty()) return;
  for (const JointEffect& effect : model.effects)
    free->push_back(part.FirstInternal() + effect.parameter);
}

// Chooses effects and identifies again with them; part.problem.model is &result->model throughout.
absl::Status AddChosenEffects(CalibrationRun* run, CalibrationResult* result) {
  if (run->options.effects != EffectsMode::kAuto) return absl::OkStatus();
  result->effects = ChooseEffects(*run->problem.robot, run->part.problem, result->identification,
                                  run->options.effect_choice);
  if (result->effects.groups.empty()) return absl::OkStatus();
  result->effect_groups = result->effects.groups;
  TRUEPOSE_ASSIGN_OR_RETURN(result->model,
                            ModelOf(run->problem, run->options, result->effect_groups));
  std::vector<int> free = run->identify.free;
  TRUEPOSE_RETURN_IF_ERROR(Prepare(result->model, run));
  FreeEffects(result->model, run->part.problem, &free);
  run->identify.free = std::move(free);
  result->before.estimate.lambda.conservativeResizeLike(run->start_lambda);
  return IdentifyParameters(run, 0.7, 0.9, result);
}

}  // namespace

absl::StatusOr<CalibrationResult> Calibrate(const CalibrationProblem& problem,
                                            const CalibrateOptions& options, const Hooks& hooks) {
  TRUEPOSE_RETURN_IF_ERROR(CheckProblem(problem));
  CalibrationResult result;
  result.effect_groups = ListedEffects(options);
  TRUEPOSE_ASSIGN_OR_RETURN(result.model, ModelOf(problem, options, result.effect_groups));
  CalibrationRun run{problem,
                     options,
                     StagedHooks(hooks),
                     PartOf(problem, result.model, problem.calibrates),
                     options.identify,
                     {},
                     {}};
  run.identify.X_FT_nominal = problem.X_FT_nominal.value_or(Pose{});
  TRUEPOSE_RETURN_IF_ERROR(CheckEffects(*problem.robot, run.part.problem, result.effect_groups));
  TRUEPOSE_RETURN_IF_ERROR(Prepare(result.model, &run));
  TRUEPOSE_RETURN_IF_ERROR(FindBefore(&run, &result.before));
  TRUEPOSE_RETURN_IF_ERROR(IdentifyParameters(&run, 0.3, 0.5, &result));
  TRUEPOSE_RETURN_IF_ERROR(SelectParameters(&run, &result));
  TRUEPOSE_RETURN_IF_ERROR(AddChosenEffects(&run, &result));
  CentreEffects(run.part.problem, result.identification.set.active,
                &result.identification.estimate);
  if (options.require_complete)
    TRUEPOSE_RETURN_IF_ERROR(CheckComplete(result.identification.set, result.candidates));
  TRUEPOSE_RETURN_IF_ERROR(CheckNamed(run.scope, result.identification.set, result.candidates));
  if (HoldsTheRest(options)) {
    const Eigen::MatrixXd stored = InternalCovariance(*options.stored, result.model.parameters);
    result.held_fit = TestHeldFit(run.part.problem, stored, result.identification);
    result.change = TestChange(run.part.problem, run.start_lambda, stored, &result.identification);
  }
  TRUEPOSE_ASSIGN_OR_RETURN(
      result.joints,
      CompareJointSources(problem, run.part, options.identify.solve.estimator,
                          result.identification, run.stages.For("assessment", 0.9, 0.95)));
  TRUEPOSE_RETURN_IF_ERROR(
      Assess(problem, run.part, run.stages.For("assessment", 0.95, 1), &result));
  hooks.Report({"assessment", 1, result.identification.summary.iterations,
                result.identification.summary.final_cost});
  return result;
}

}  // namespace truepose
