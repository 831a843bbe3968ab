#include "core/calibrate/calibrate.h"

#include <algorithm>

#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/calibrate/assess.h"
#include "core/calibrate/checks.h"
#include "core/calibrate/gauge.h"
#include "core/calibrate/parameter_choice.h"
#include "core/calibrate/scope.h"
#include "core/calibrate/sets.h"
#include "core/calibrate/staged_hooks.h"
#include "core/models/build_model.h"

namespace truepose {
namespace {

// What the whole run shares; refers to the caller's problem and options.
struct Run {
  const CalibrationProblem& problem;
  const CalibrateOptions& options;
  StagedHooks stages;
  Part part;
  IdentifyOptions identify;
  Scope scope;
  Eigen::VectorXd start_lambda;  // nominal, or that of the stored calibration
};

absl::StatusOr<Model> ModelOf(const CalibrationProblem& problem, const CalibrateOptions& options,
                              const std::vector<EffectGroup>& effects) {
  TRUEPOSE_ASSIGN_OR_RETURN(Model model,
                            BuildModel(options.model, *problem.robot, ModelExtent::kInternal));
  for (EffectGroup group : effects) AddEffects(*problem.robot, group, &model);
  return model;
}

bool HoldsTheRest(const CalibrateOptions& options) {
  return options.prior == PriorKind::kStored && IsPartial(options.calibrate);
}

// The prior, the scope and what a stored calibration gives, for the run's model.
absl::Status Prepare(const Model& model, Run* run) {
  const CalibrateOptions& options = run->options;
  run->part.problem.prior.reset();
  run->start_lambda = Eigen::VectorXd::Zero(model.parameters.size());
  if (options.prior == PriorKind::kTolerance)
    run->part.problem.prior = PriorOf(options.tolerance, model.parameters);
  if (options.prior == PriorKind::kStored) {
    TRUEPOSE_RETURN_IF_ERROR(CheckConvention(*options.stored, model));
    TRUEPOSE_ASSIGN_OR_RETURN(Prior prior, PriorOf(*options.stored, model.parameters));
    run->start_lambda = prior.mean;
    if (HoldsTheRest(options)) {
      run->identify.known_model_error = options.stored->model_error;
    } else {
      run->part.problem.prior = std::move(prior);
    }
  }
  if (!run->part.problem.prior && !model.effects.empty() && !HoldsTheRest(options))
    run->part.problem.prior = NoPrior(model.parameters);
  if (run->part.problem.prior) AddEffectPrior(model.parameters, &*run->part.problem.prior);
  TRUEPOSE_ASSIGN_OR_RETURN(run->scope, ScopeOf(options.calibrate, run->part.problem));
  run->identify.free = run->scope.free;
  return absl::OkStatus();
}

// Frames that the scope holds must be known.
absl::StatusOr<StartOptions> StartOptionsOf(const Run& run) {
  const Problem& part = run.part.problem;
  StartOptions start{run.problem.X_FT_nominal, NominalEstimate(part),
                     std::vector<bool>(part.placements.size(), false),
                     std::vector<bool>(part.targets.size(), false)};
  FaultList faults;
  for (size_t t = 0; t < part.targets.size() && !run.scope.tool; ++t) {
    if (!run.problem.X_FT_nominal)
      faults.Add("options.nominal_tool", "none", "the tool that calibrate = base holds");
    start.known.X_FT[t] = run.problem.X_FT_nominal.value_or(Pose{});
    start.tool_known[t] = true;
  }
  for (size_t p = 0; p < part.placements.size() && !run.scope.base; ++p) {
    const size_t whole = static_cast<size_t>(run.part.placements[p]);
    const bool known =
        whole < run.problem.X_MB_known.size() && run.problem.X_MB_known[whole].has_value();
    if (!known)
      faults.Add("options.prior_calibration",
                 "no base frame of placement '" + part.placements[p] + "'",
                 "a calibration with this placement: calibrate = tool holds its base");
    if (known) start.known.X_MB[p] = *run.problem.X_MB_known[whole];
    start.base_known[p] = true;
  }
  if (!faults.empty()) return faults.ToStatus();
  return start;
}

absl::Status FindBefore(Run* run, CalibrationResult* result) {
  TRUEPOSE_ASSIGN_OR_RETURN(const StartOptions options, StartOptionsOf(*run));
  TRUEPOSE_ASSIGN_OR_RETURN(Estimate start, FindStart(run->part.problem, options,
                                                      run->stages.For("start_values", 0, 0.1)));
  start.lambda = run->start_lambda;
  TRUEPOSE_RETURN_IF_ERROR(
      CheckJointSpace(*run->problem.robot, run->part.problem, start, run->identify));
  TRUEPOSE_ASSIGN_OR_RETURN(result->before, FitFrames(run->part.problem, start, run->identify,
                                                      run->stages.For("start_values", 0.1, 0.3)));
  return absl::OkStatus();
}

absl::Status IdentifyParameters(Run* run, double from, double to, CalibrationResult* result) {
  const Problem& part = run->part.problem;
  const IdentifiableSet generic = GenericIdentifiable(part, *run->problem.robot);
  result->generic_rank = static_cast<int>(generic.active.size());
  result->counts = CountParameters(*run->problem.robot, part, generic);
  TRUEPOSE_ASSIGN_OR_RETURN(result->identification,
                            Identify(part, generic, result->before, run->identify,
                                     run->stages.For("identification", from, to)));
  result->candidates = Candidates(part);
  return CheckRedundancy(result->identification);
}

// Chooses among the geometric parameters and identifies those alone.
absl::Status SelectParameters(Run* run, CalibrationResult* result) {
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
absl::Status AddChosenEffects(Run* run, CalibrationResult* result) {
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
  result.effect_groups =
      options.effects == EffectsMode::kListed ? options.effect_groups : std::vector<EffectGroup>{};
  TRUEPOSE_ASSIGN_OR_RETURN(result.model, ModelOf(problem, options, result.effect_groups));
  Run run{problem,
          options,
          StagedHooks(hooks),
          PartOf(problem, result.model, problem.calibrates),
          options.identify,
          {},
          {}};
  run.identify.X_FT_nominal = problem.X_FT_nominal.value_or(Pose{});
  TRUEPOSE_RETURN_IF_ERROR(CheckEffects(*problem.robot, run.part.problem, result.effect_groups));
  TRUEPOSE_RETURN_IF_ERROR(Prepare(result.model, &run));
  TRUEPOSE_RETURN_IF_ERROR(FindBefore(&run, &result));
  TRUEPOSE_RETURN_IF_ERROR(IdentifyParameters(&run, 0.3, 0.5, &result));
  TRUEPOSE_RETURN_IF_ERROR(SelectParameters(&run, &result));
  TRUEPOSE_RETURN_IF_ERROR(AddChosenEffects(&run, &result));
  CentreEffects(run.part.problem, result.identification.set.active,
                &result.identification.estimate);
  if (options.require_complete)
    TRUEPOSE_RETURN_IF_ERROR(CheckComplete(result.identification.set, result.candidates));
  if (HoldsTheRest(options)) {
    TRUEPOSE_RETURN_IF_ERROR(CheckNamed(run.scope, result.identification.set, result.candidates));
    const Eigen::MatrixXd stored = InternalCovariance(*options.stored, result.model.parameters);
    result.held_fit = TestHeldFit(run.part.problem, stored, result.identification);
    result.change = TestChange(run.part.problem, run.start_lambda, stored, &result.identification);
  }
  TRUEPOSE_RETURN_IF_ERROR(
      Assess(problem, run.part, run.stages.For("assessment", 0.9, 1), &result));
  hooks.Report({"assessment", 1, result.identification.summary.iterations,
                result.identification.summary.final_cost});
  return result;
}

}  // namespace truepose
